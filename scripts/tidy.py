#!/usr/bin/env python3
"""Runs clang-tidy on every source file that changed since it last passed; on a folder's files together
where the build compiles them so. The tests' own files are left to the compiler's warnings:
GoogleTest's macros make up half of what they hold.

Usage: tidy.py BUILD, a configured build folder with compile_commands.json"""

import subprocess
import sys
from pathlib import Path

from compile_units import ROOT, check_units, compile_units, is_unity

# The files are compiled with GCC's warnings, of which Clang does not know all. libstdc++ 12 itself uses what is
# deprecated. Kernels are looked at for one instruction set, and Eigen without its assertions and vectors, which take a
# tenth of the time.
TIDY = ["clang-tidy", "--quiet", f"--config-file={ROOT}/.clang-tidy",
        "--extra-arg=-Wno-unknown-warning-option", "--extra-arg=-Wno-unused-command-line-argument",
        "--extra-arg=-Wno-deprecated-declarations", "--extra-arg=-DHWY_COMPILE_ONLY_STATIC",
        f"--extra-arg=-I{ROOT}",
        *(f"--extra-arg=-DEIGEN_{name}" for name in ("NO_DEBUG", "NO_STATIC_ASSERT", "DONT_VECTORIZE"))]
LINTED = tuple(f"{ROOT}/{folder}/" for folder in ("beeline", "cli", "examples", "mpi", "python"))


def main(build):
    units = [unit for unit in compile_units(build) if unit["file"].startswith(LINTED) or is_unity(unit["file"])]
    # Emscripten alone compiles these, together; clang-tidy takes the flags of the nearest file.
    like = next(unit for unit in units if unit["file"] == f"{ROOT}/cli/main.cpp")
    page = Path(build).resolve() / "page.cpp"
    paths = sorted((ROOT / "web" / "core").glob("*.cpp"))
    page.write_text("".join(f"#include <{path.relative_to(ROOT).as_posix()}>\n" for path in paths))
    units.append({**like, "file": str(page)})

    def tidy(unit):
        done = subprocess.run([*TIDY, "-p", build, unit["file"]], capture_output=True, text=True)
        return "" if done.returncode == 0 else done.stdout or done.stderr

    version = subprocess.run([TIDY[0], "--version"], capture_output=True, check=True).stdout
    settings = (ROOT / ".clang-tidy").read_bytes() + version + " ".join(TIDY).replace(str(ROOT), "").encode()
    return int(check_units("clang-tidy", units, settings, tidy))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
