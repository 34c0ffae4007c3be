"""What `progress=True` shows: the fraction computed, on stderr."""

import importlib
import importlib.util
import sys
import time
from typing import Any

__all__ = ["ProgressBar"]


class ProgressBar:
    """Shows a fraction from 0 to 1 that it is called with: a bar of tqdm where that is installed, else a
    line of text. Nothing is shown of work that takes less than `delay` seconds."""

    def __init__(self, description: str = "beeline", delay: float = 0.3) -> None:
        self.description = description
        self.fraction = 0.0
        self._shown_from = time.monotonic() + delay
        self._bar: Any = None
        self._percent = -1  # on the line of text
        self._closed = False

    def __call__(self, fraction: float) -> None:
        self.fraction = min(1.0, max(self.fraction, fraction))
        if self._closed or sys.stderr is None:
            return
        begun = self._bar is not None or self._percent >= 0
        if not begun and time.monotonic() < self._shown_from:
            return
        if self._bar is None and self._percent < 0:
            self._bar = self._tqdm()
        if self._bar is not None:
            self._bar.update(100 * self.fraction - self._bar.n)
        else:
            self._write()
        if self.fraction >= 1:
            self.close()

    def close(self) -> None:
        """Ends the bar or the line. Work that its budget ends does so below 100 %."""
        if self._bar is not None:
            self._bar.close()
        elif self._percent >= 0 and not self._closed:
            print(file=sys.stderr, flush=True)
        self._closed = True

    def __del__(self) -> None:
        if not sys.is_finalizing():
            self.close()

    def _tqdm(self) -> Any:
        if importlib.util.find_spec("tqdm") is None:
            return None
        tqdm: Any = importlib.import_module("tqdm.auto").tqdm
        form = "{desc}: {percentage:3.0f}%|{bar}| {elapsed}<{remaining}"
        return tqdm(total=100.0, desc=self.description, bar_format=form)

    def _write(self) -> None:
        percent = int(100 * self.fraction)
        if percent != self._percent:
            self._percent = percent
            print(f"\r{self.description}: {percent:3d} %", end="", file=sys.stderr, flush=True)
