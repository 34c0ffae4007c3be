"""The command line: `python -m beeline`, and the script `beeline`."""

import os
import signal
import sys

from ._core import _command_line


def main() -> int:
    """Runs the command with the process's arguments and returns the exit code, 0 to 3."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)  # as in the command: verbs catch what they need
    return _command_line([os.fsencode(word) for word in sys.argv])


if __name__ == "__main__":
    sys.exit(main())
