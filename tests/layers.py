"""The order of the folders, as layers.txt holds it: which includes in beeline/ break it.

A folder includes itself, its internal/, the folders that layers.txt names for it, and what stands beside the
folders (error.h). Other people's libraries, but for Eigen, appear only in the folders below, and
there in .cpp files and in what these include for each instruction set (-inl.h)."""

import re
import sys
from pathlib import Path

LIBRARIES = {  # the first part of the include: the folders that may use it, in .cpp files
    "cairo": {"draw"},
    "hwy": {
        "simd",
        "kinematics",
        "batch",
        "inverse/analytic",
        "inverse/numerical",
        "timing",
    },
    "fast_float": {"read"},
    "fmt": {"read"},
    "nlohmann": {"read", "record"},
    "oneapi": {"batch"},
    "tbb": {"batch"},
    "tinyxml2": {"read"},
}
UMBRELLA = "beeline/beeline.h"  # includes the public headers of the library core, all of them
NOT_CORE = {"batch", "draw", "read", "record"}
PRIVATE = re.compile(r"-inl\.h$|/internal/|^beeline/(math|inverse/analytic|inverse/numerical)/")
SYSTEM = {"fcntl", "sys", "unistd"}  # C headers that any .cpp may use

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def read_layers(path):
    """folder -> the folders it may include. Raises ValueError for an order that is none."""
    layers = {}
    for line in path.read_text().splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        folder, _, below = line.partition(":")
        for name in below.split():
            if name not in layers:
                raise ValueError(f"layers.txt: {folder} may include {name}, which is not below it")
        if folder in layers:
            raise ValueError(f"layers.txt: {folder} stands there twice")
        layers[folder] = set(below.split())
    return layers


def violations(root):
    """One sentence for each include, and each folder, that breaks the order."""
    house = root / "beeline"
    layers = read_layers(root / "layers.txt")
    folders = {folder_of(path.relative_to(house)) for path in sources(house)} - {"."}
    found = [f"beeline/{folder} is not in layers.txt" for folder in folders - layers.keys()]
    found += [f"layers.txt: there is no beeline/{folder}" for folder in layers.keys() - folders]
    for path in sources(house):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            include = INCLUDE.match(line)
            reason = include and objection(root, layers, path, *include.groups())
            if reason:
                place = f"{path.relative_to(root)}:{number}"
                found.append(f"{place}: {include.group(2)}: {reason}")
    return sorted(found + missing_in_umbrella(root))


def missing_in_umbrella(root):
    umbrella = root / UMBRELLA
    if not umbrella.is_file():
        return []
    included = set(re.findall("#include <(.*)>", umbrella.read_text()))
    headers = {path.relative_to(root) for path in sources(root / "beeline") if path.suffix == ".h"}
    public = {
        path.as_posix()
        for path in headers
        if not PRIVATE.search(path.as_posix()) and path.parts[1] not in NOT_CORE
    }
    return [f"{UMBRELLA} does not include {name}" for name in public - included - {UMBRELLA}]


def sources(house):
    return sorted(path for path in house.rglob("*") if path.suffix in {".h", ".cpp"})


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
            return "it is not in the library core" if target in NOT_CORE else None
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
