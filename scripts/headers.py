#!/usr/bin/env python3
"""Compiles each public header alone: it includes what it uses. One that passed is compiled again when it, or a header
that it includes, has changed.

Usage: headers.py BUILD, a configured build folder with compile_commands.json"""

import shlex
import subprocess
import sys
import tempfile
from pathlib import Path

from compile_units import ROOT, check_units, closure, compile_units

sys.path.append(str(ROOT / "tests"))
from layers import UMBRELLA, is_public, sources  # noqa: E402

# Half of the time goes into this one, which is compiled once, for the headers that include it.
EIGEN = "Eigen/Core"


def public_headers():
    library = ROOT / "beeline"
    headers = [path for path in sources(library) if is_public(path.relative_to(library))]
    return [path for path in headers if path.relative_to(ROOT).as_posix() != UMBRELLA]


def compiler(build):
    """The command that the build folder compiles C++ with: its standard, its warnings, and where it finds Eigen."""
    unit = next(unit for unit in compile_units(build) if unit["file"] == f"{ROOT}/cli/main.cpp")
    words = [word for word in shlex.split(unit["command"]) if not word.endswith("ccache")]
    places = [word for name, place in zip(words, words[1:]) if name == "-isystem" for word in (name, place)]
    return [words[0], *(word for word in words if word.startswith(("-std=", "-W"))), f"-I{ROOT}", *places]


def main(build):
    compile = compiler(build)
    with tempfile.TemporaryDirectory() as folder:
        eigen = Path(folder) / "eigen.h"
        eigen.write_text(f"#include <{EIGEN}>\n")
        subprocess.run([*compile, "-x", "c++-header", eigen, "-o", f"{eigen}.gch"], check=True)

        def alone(unit):
            path = Path(unit["file"])
            before = ["-include", eigen] if any(b"<Eigen/" in file.read_bytes() for file in closure(path)) else []
            # As what is included: a header that is itself compiled may not say #pragma once.
            text = f"#include <{path.relative_to(ROOT).as_posix()}>\n"
            command = [*compile, *before, "-fsyntax-only", "-x", "c++", "-"]
            done = subprocess.run(command, input=text, capture_output=True, text=True)
            return "" if done.returncode == 0 else done.stderr or f"{path}: the compiler failed\n"

        units = [{"file": str(path), "command": shlex.join(compile)} for path in public_headers()]
        version = subprocess.run([compile[0], "--version"], capture_output=True, check=True).stdout
        return int(check_units("public headers", units, version + EIGEN.encode(), alone))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
