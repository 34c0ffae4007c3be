"""The page as one HTML document, made of saved.html and the files that it names: as web/src/share/save_page.ts does."""

from __future__ import annotations

import base64
import re
import tarfile
import tempfile
import zlib
from functools import lru_cache
from pathlib import Path
from urllib.parse import urlencode

from ._core import Arm, CollisionModel, Error, Trajectory, _collision_files

_PART = re.compile(r' data-file="([^"]+)">(?=</script>)')
"""Where saved.html names the file of a part."""


def document_of(
    arm: Arm,
    q: list[float] | None,
    trajectory: Trajectory | None,
    section: str | None = None,
    model: CollisionModel | None = None,
) -> str:
    """The page of an arm, which begins at `q` in a section and plays the trajectory among the obstacles of the model."""
    state = {"json": arm.to_json()}
    if model is not None:
        state["json"], state["scene"] = _collision_files(model)
    state = {key: _deflated(text.encode()) for key, text in state.items()}
    if model is not None:
        state["clearance"] = repr(model.clearance)
    texts = {}
    if q is not None:
        state["q"] = ",".join(map(repr, q))
    if section is None and trajectory is not None:
        section = "line"  # which plays it
    if section is not None:
        state["section"] = section
    if trajectory is not None:
        texts["trajectory"] = _deflated(_csv(trajectory))
    texts["state"] = urlencode(state, safe=",")
    document = _empty_document()
    for name, text in texts.items():
        begin = f'<script type="text/plain" id="saved-{name}">'
        document = document.replace(f"{begin}</script>", f"{begin}{text}</script>", 1)
    return document


def _csv(trajectory: Trajectory) -> bytes:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "motion.csv"
        trajectory.save(path)
        return path.read_bytes()


def _deflated(content: bytes) -> str:
    """As the page reads it: deflated, in base64 with - and _ for + and /, and without =."""
    stream = zlib.compressobj(9, wbits=-15)
    return base64.urlsafe_b64encode(stream.compress(content) + stream.flush()).decode().rstrip("=")


@lru_cache(maxsize=1)
def _empty_document() -> str:
    files = _files()
    template = files["saved.html"].decode()
    return _PART.sub(lambda found: f">{_deflated(files[found[1]])}", template)


def _files() -> dict[str, bytes]:
    """saved.html and the files that it names: from the wheel, or where `make web` puts them in a checkout."""
    here = Path(__file__).resolve().parent
    archive = here / "page.tar.xz"
    if archive.is_file():
        with tarfile.open(archive, "r:xz") as tar:
            contents = ((member.name, tar.extractfile(member)) for member in tar)
            return {name: file.read() for name, file in contents if file is not None}
    folder = here.parents[1] / "build" / "web"
    if not (folder / "saved.html").is_file():
        raise Error("the page is not built: `make web` builds it in a checkout of Beeline, and the wheel carries it")
    template = (folder / "saved.html").read_bytes()
    names = ["saved.html", *_PART.findall(template.decode())]
    return {name: (folder / name).read_bytes() for name in names}
