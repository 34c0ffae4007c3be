#!/usr/bin/env python3
"""Runs clang-tidy on every source file that changed since it last passed; on a folder's files together
where the build compiles them so. The tests' own files are left to the compiler's warnings:
GoogleTest's macros make up half of what they hold.

Usage: tidy.py BUILD, a configured build folder with compile_commands.json

A file that passes leaves a stamp, named by the hash of all that its findings depend on: its text
and that of the headers of ours that it includes, how it is compiled, and the checks. The stamps
stand in BEELINE_LINT_STAMPS, or else in build/lint."""

import hashlib
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
STAMPS = Path(os.environ.get("BEELINE_LINT_STAMPS", ROOT / "build" / "lint"))
# The files are compiled with GCC's warnings, of which Clang does not know all.
# Kernels are looked at for one instruction set. What is deprecated in C++20 is used by libstdc++ 12 itself.
TIDY = ["clang-tidy", "--quiet", f"--config-file={ROOT}/.clang-tidy",
        "--extra-arg=-Wno-unknown-warning-option", "--extra-arg=-Wno-unused-command-line-argument",
        "--extra-arg=-Wno-deprecated-declarations", "--extra-arg=-DHWY_COMPILE_ONLY_STATIC"]
LINTED = tuple(f"{ROOT}/{folder}/" for folder in ("beeline", "cli", "examples", "mpi", "python"))
INCLUDE = re.compile(rb'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


@lru_cache(maxsize=None)
def includes(path):
    """Our own files that the file includes itself."""
    names = [name.decode() for name in INCLUDE.findall(path.read_bytes())]
    places = [folder / name for name in names for folder in (ROOT, path.parent)]
    return [place.resolve() for place in places if place.is_file()]


def closure(path):
    """The file and all of ours that it includes, in an order of its own."""
    found, waiting = {path}, [path]
    while waiting:
        for header in includes(waiting.pop()):
            if header not in found:
                found.add(header)
                waiting.append(header)
    return sorted(found)


def stamp(entry, settings):
    digest = hashlib.sha256(settings)
    digest.update(entry["command"].replace(str(ROOT), "").encode())
    for path in closure(Path(entry["file"]).resolve()):
        digest.update(str(path.relative_to(ROOT)).encode() + b"\0" + path.read_bytes() + b"\0")
    return STAMPS / digest.hexdigest()


def tidy(build, entry, passed):
    """Empty when all is well, else what clang-tidy says."""
    if passed.exists():
        passed.touch()
        return ""
    done = subprocess.run([*TIDY, "-p", build, entry["file"]], capture_output=True, text=True)
    if done.returncode == 0:
        passed.touch()
        return ""
    return done.stdout or done.stderr


def is_unity(path):
    """Whether the build compiles a folder of the library or the command as this file."""
    return "/Unity/" in path and "/tests/" not in path


def main(build):
    entries = json.loads((Path(build) / "compile_commands.json").read_text())
    entries = [e for e in entries if e["file"].startswith(LINTED) or is_unity(e["file"])]
    # Emscripten alone compiles these; clang-tidy takes the flags of the nearest file.
    like = next(e for e in entries if e["file"] == f"{ROOT}/cli/main.cpp")
    entries += [{**like, "file": str(path)} for path in sorted((ROOT / "web" / "core").glob("*.cpp"))]
    version = subprocess.run([TIDY[0], "--version"], capture_output=True, check=True).stdout
    settings = (ROOT / ".clang-tidy").read_bytes() + version + " ".join(TIDY).encode()
    STAMPS.mkdir(parents=True, exist_ok=True)

    stamps = [stamp(entry, settings) for entry in entries]
    new = sum(not path.exists() for path in stamps)
    print(f"clang-tidy: {len(entries)} files, {new} to look at", flush=True)
    found = False
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for findings in pool.map(tidy, [build] * len(entries), entries, stamps):
            found = found or findings != ""
            print(findings, end="", flush=True)
    return int(found)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
