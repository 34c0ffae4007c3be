"""The files that a build compiles, and checks of them that are repeated only after a change.

A file that passed a check leaves a stamp, named by the hash of all that the check depends on: the file's text and the
text of our own headers that it includes, how it is compiled, and the check's settings. The stamps stand in
BEELINE_LINT_STAMPS, or else in build/lint."""

import hashlib
import json
import os
import re
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STAMPS = Path(os.environ.get("BEELINE_LINT_STAMPS", ROOT / "build" / "lint"))
INCLUDE = re.compile(rb'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


def compile_units(build):
    """The entries of a configured build folder's compile_commands.json."""
    return json.loads((Path(build) / "compile_commands.json").read_text())


def is_unity(path):
    """Whether the build compiles a folder of the library, the command or the Python module as this file."""
    return "/Unity/" in path and "/tests/" not in path


@lru_cache(maxsize=None)
def includes(path):
    """Our own files that the file includes itself."""
    names = [name.decode() for name in INCLUDE.findall(path.read_bytes())]
    places = [folder / name for name in names for folder in (ROOT, path.parent)]
    return [place.resolve() for place in places if place.is_file()]


def closure(path):
    """The file and all of ours that it includes, sorted."""
    found, waiting = {path}, [path]
    while waiting:
        for header in includes(waiting.pop()):
            if header not in found:
                found.add(header)
                waiting.append(header)
    return sorted(found)


def stamp(unit, settings):
    digest = hashlib.sha256(settings)
    digest.update(unit["command"].replace(str(ROOT), "").encode())
    for path in closure(Path(unit["file"]).resolve()):
        if path.is_relative_to(ROOT):
            digest.update(str(path.relative_to(ROOT)).encode() + b"\0" + path.read_bytes() + b"\0")
    return STAMPS / digest.hexdigest()


def check_units(name, units, settings, check):
    """Runs check(unit), which returns its findings as text, on all units that changed since they passed, and prints the
    findings. Returns whether there are any. `settings`: bytes that identify the check."""
    STAMPS.mkdir(parents=True, exist_ok=True)
    stamps = [stamp(unit, settings) for unit in units]
    print(f"{name}: {len(units)} files, {sum(not path.exists() for path in stamps)} to look at", flush=True)

    def findings_of(unit, passed):
        findings = "" if passed.exists() else check(unit)
        if not findings:
            passed.touch()
        return findings

    found = False
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for findings in pool.map(findings_of, units, stamps):
            found = found or findings != ""
            print(findings, end="", flush=True)
    return found
