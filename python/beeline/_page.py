"""The page of an arm as one HTML document: `view()`, in a notebook or in the browser."""

from __future__ import annotations

import contextlib
import errno
import os
import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from ._core import Arm, CollisionModel, Error, Trajectory, _arm_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

__all__ = ["Page", "view"]

SECTIONS = ("pose", "control", "line", "obstacles", "workspace", "lessons")


class Page:
    """The page of an arm: one HTML document with page, core and arm inside, which needs no server and no network.

    `html` is the document, about 4 MB; `height` the height of the frame in a notebook, pixels.
    """

    def __init__(self, html: str, height: int = 640) -> None:
        self.html = html
        self.height = height

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the document to a file, which browsers open from a disk. An existing file is replaced as a whole.

        Parameters
        ----------
        path : str | os.PathLike[str]
            A .html file.

        Raises
        ------
        beeline.Error
            For another ending, and for a file that cannot be written.
        """
        if not os.fspath(path).lower().endswith((".html", ".htm")):
            raise Error(f"{path}: a page is written to a .html file")
        try:
            _replace(os.path.realpath(path), self.html)  # the file that a link names, not the link
        except OSError as error:
            raise Error(f"{path}: {error.strerror}") from None

    def _repr_html_(self) -> str:
        import html

        frame = f'width="100%" height="{self.height}" style="border: 0" title="Beeline: an arm to hold"'
        return f'<iframe srcdoc="{html.escape(self.html)}" {frame}></iframe>'

    def __repr__(self) -> str:
        return f"<beeline.Page, {len(self.html)} characters of HTML>"


def view(
    arm: Arm | CollisionModel | str, q: ArrayLike | None = None, trajectory: Any = None, section: str | None = None
) -> Page:
    """Shows an arm in the page that `beeline view` serves: sliders, the tool dragged by hand, control, lines.

    In a notebook the page is displayed where the result is the value of the cell. Elsewhere the browser opens it,
    from a file in the folder for temporary files.

    Parameters
    ----------
    arm : Arm or CollisionModel or str
        The arm, or the name of a built-in one, or the arm among obstacles: the page has them, and the shapes of the links.
    q : array_like, default None
        Configuration (n,) that the page begins with. Default: `display_configuration(arm)`. A motion in its place is
        the trajectory.
    trajectory : Trajectory, or a result that has a `trajectory`, default None
        A motion to play.
    section : {"pose", "control", "line", "obstacles", "workspace", "lessons"}, default None
        The section of the page to begin with. Default: "pose", or "line" with a trajectory.

    Returns
    -------
    Page
        Notebooks show it, `save()` writes it.

    Raises
    ------
    beeline.Error
        For `q` of another shape or not finite; for a `trajectory` with joints that the arm does not have; for another
        `section`; if the page is not built: wheels carry it, in a checkout `make web` builds it.
    TypeError
        For an `arm` that is none, for `trajectory` that is none and has none.
    """
    from ._page_document import document_of  # here, as few programs need what it imports

    model = arm if isinstance(arm, CollisionModel) else None
    arm = model.arm if model else _arm_of(arm)
    if section is not None and section not in SECTIONS:
        raise Error(f"section: expected one of {', '.join(SECTIONS)}, not {section!r}")
    if trajectory is None and isinstance(getattr(q, "trajectory", q), Trajectory):
        q, trajectory = None, q
    values = None if q is None else _configuration(arm, q)
    trajectory = getattr(trajectory, "trajectory", trajectory)
    if trajectory is not None and not isinstance(trajectory, Trajectory):
        raise TypeError(f"trajectory: expected a Trajectory or a result that has one, not {type(trajectory).__name__}")
    page = Page(document_of(arm, values, trajectory and trajectory.matched_to(arm), section, model))
    if not _in_notebook():
        _open_browser(page)
    return page


def _replace(path: str, text: str) -> None:
    """Writes a file beside the path, then renames it: a reader finds the old content or the new one."""
    if os.path.exists(path) and not os.access(path, os.W_OK):  # which a rename would ignore
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))
    beside = f"{path}.{os.getpid()}.new"
    try:
        with open(beside, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(beside, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(beside)
        raise


def _configuration(arm: Arm, q: ArrayLike) -> list[float]:
    values = np.asarray(q, dtype=float)
    if values.shape != (arm.dof,):
        raise Error(f"q has the shape {values.shape}; expected ({arm.dof},)")
    if not np.isfinite(values).all():
        raise Error("q must be finite")
    return [float(value) for value in values]


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return getattr(shell, "kernel", None) is not None


def _open_browser(page: Page) -> None:
    import tempfile
    import webbrowser  # which loads modules of the network
    from pathlib import Path

    with tempfile.NamedTemporaryFile("w", encoding="utf-8", prefix="beeline-", suffix=".html", delete=False) as file:
        file.write(page.html)
    if not webbrowser.open(Path(file.name).as_uri()):
        print(f"beeline.view: there is no browser; the page is {file.name}", file=sys.stderr)
