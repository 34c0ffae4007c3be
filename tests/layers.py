"""Checks the includes of beeline/ against layers.txt, and the public headers.

A folder includes itself, its internal/, the folders that layers.txt names for it, and the files beside
the folders (error.h). Libraries other than Eigen appear only in the folders listed below, in .cpp
files and in -inl.h files. A public header, which is installed, includes no internal one, and includes
error.h when it promises "Throws Error". What stands outside of beeline/, except its tests, uses public
headers alone, and no name of beeline::internal."""

import re
import sys
from pathlib import Path

LIBRARIES = {  # the first part of the include: the folders that may use it, in .cpp files
    "assimp": {"io/text"},
    "cairo": {"draw"},
    "hwy": {
        "simd",
        "collision",
        "kinematics",
        "batch",
        "inverse/analytic",
        "inverse/numerical",
        "timing",
    },
    "fast_float": {"io/text"},
    "hdf5": {"reach"},
    "zlib": {"reach"},
    "fmt": {"io/text"},
    "nlohmann": {"io/text", "io"},
    "oneapi": {"batch"},
    "sanitizer": {"batch"},
    "tbb": {"batch"},
    "tinyxml2": {"io/text"},
    "yaml": {"io/text"},
}
OUTSIDE = ("cli", "python/src", "mpi", "web/core", "bench", "examples")
UMBRELLA = "beeline/beeline.h"  # includes every public header
# Not installed: all of these folders, every internal/ and -inl.h.
INTERNAL = {"simd", "math", "reason", "inverse/analytic", "inverse/numerical"}
MAX_PUBLIC_HEADERS = 66  # model/moving_base.h is the 66th
ERROR = ("beeline/error.h", "beeline/beeline.h")
SYSTEM = {"dlfcn", "fcntl", "poll", "spawn", "sys", "unistd"}  # C headers that any .cpp may use

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def read_layers(path):
    """folder -> the folders it may include. Raises ValueError for an invalid order."""
    layers = {}
    for line in path.read_text().splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        folder, _, below = line.partition(":")
        for name in below.split():
            if name not in layers:
                raise ValueError(f"layers.txt: {folder} may include {name}, which is not below it")
        if folder in layers:
            raise ValueError(f"layers.txt: {folder} is listed twice")
        layers[folder] = set(below.split())
    return layers


def violations(root):
    """One sentence for each include, folder and public header that breaks a rule."""
    library = root / "beeline"
    layers = read_layers(root / "layers.txt")
    folders = {folder_of(path.relative_to(library)) for path in sources(library)} - {"."}
    found = [f"beeline/{folder} is not in layers.txt" for folder in folders - layers.keys()]
    found += [f"layers.txt: there is no beeline/{folder}" for folder in layers.keys() - folders]
    for path in sources(library):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            include = INCLUDE.match(line)
            reason = include and objection(root, layers, path, *include.groups())
            if reason:
                place = f"{path.relative_to(root)}:{number}"
                found.append(f"{place}: {include.group(2)}: {reason}")
    return sorted(found + public_violations(root) + outside_violations(root))


def outside_violations(root):
    found = []
    for path in (path for folder in OUTSIDE for path in sources(root / folder)):
        text = path.read_text()
        if "fmt::join" in text and "#include <fmt/ranges.h>" not in text:
            found.append(f"{path.relative_to(root)}: fmt::join() of fmt 11 needs <fmt/ranges.h>")
        for number, line in enumerate(text.splitlines(), 1):
            include = INCLUDE.match(line)
            target = Path(include.group(2).removeprefix("beeline/")) if include else None
            place = f"{path.relative_to(root)}:{number}"
            if target and include.group(2).startswith("beeline/") and not is_public(target):
                found.append(f"{place}: only beeline/ and tests/ include the internal {target.name}")
            if re.search(r"\binternal::|\bnamespace beeline::internal\b", line):
                found.append(f"{place}: only beeline/ and tests/ use beeline::internal")
    return found


def is_public(path):
    """Whether a header, relative to beeline/, is installed."""
    return (
        path.suffix == ".h"
        and not path.name.endswith("-inl.h")
        and path.parent.name != "internal"
        and path.parent.as_posix() not in INTERNAL
    )


def public_violations(root):
    library = root / "beeline"
    found = []
    headers = [path for path in sources(library) if is_public(path.relative_to(library))]
    for path in headers:
        text = path.read_text()
        name = path.relative_to(root).as_posix()
        targets = [m.group(2) for m in map(INCLUDE.match, text.splitlines()) if m]
        for target in targets:
            first, _, rest = target.partition("/")
            if first == "beeline" and not is_public(Path(rest)):
                found.append(f"{name}: a public header includes the internal <{target}>")
        if "Throws Error" in text and name not in ERROR and ERROR[0] not in targets:
            found.append(f'{name}: it promises "Throws Error" and does not include <{ERROR[0]}>')
    umbrella = root / UMBRELLA
    if umbrella.is_file():
        included = set(re.findall("#include <(.*)>", umbrella.read_text())) | {UMBRELLA}
        names = {path.relative_to(root).as_posix() for path in headers}
        found += [f"{UMBRELLA} does not include {name}" for name in names - included]
    if len(headers) > MAX_PUBLIC_HEADERS:
        found.append(f"{len(headers)} public headers; at most {MAX_PUBLIC_HEADERS}")
    return found


def sources(library):
    return sorted(path for path in library.rglob("*") if path.suffix in {".h", ".cpp"})


def folder_of(path):
    """The folder of layers.txt that a path, relative to beeline/, belongs to."""
    folder = path.parent
    return (folder.parent if folder.name == "internal" else folder).as_posix()


def objection(root, layers, path, quote, name):
    folder = folder_of(path.relative_to(root / "beeline"))
    first, *rest = re.split("[/.-]", name)
    if quote == '"':
        return "write <beeline/...>"
    if first == "beeline":
        target = folder_of(Path(name).relative_to("beeline"))
        if not (root / name).is_file():
            return "there is no such file"
        if name == UMBRELLA:
            return "it is for users of the library"
        if path == root / UMBRELLA:
            return None
        if target not in {".", folder} | layers.get(folder, set()):
            return f"{folder} may not include {target}"
    elif first in LIBRARIES:
        if path.suffix != ".cpp" and not path.name.endswith("-inl.h"):
            return "a header does not include other people's libraries"
        if folder not in LIBRARIES[first]:
            return f"this library belongs to {' and '.join(sorted(LIBRARIES[first]))}"
    elif first in SYSTEM:
        if path.suffix != ".cpp":
            return "a header does not include the system's"
    elif first != "Eigen" and rest:
        return "no folder uses this library"
    return None


if __name__ == "__main__":
    found = violations(Path(__file__).resolve().parent.parent)
    print("\n".join(found), end="\n" if found else "")
    sys.exit(bool(found))
