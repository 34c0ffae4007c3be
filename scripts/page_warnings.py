#!/usr/bin/env python3
"""Compiles, as far as the warnings go, every source file of the page's modules that changed since it last passed: by
Clang with libc++ for 32 bits, whose narrower sizes warn of conversions that no 64-bit compiler sees.

Usage: page_warnings.py BUILD, the configured build folder of the preset web"""

import os
import shlex
import subprocess
import sys

from compile_units import ROOT, check_units, compile_units, is_unity


WARNINGS = ["-fsyntax-only", "-Werror"]


def syntax_only(command):
    """The command without the object file that it writes."""
    words = shlex.split(command)
    at = words.index("-o")
    return [*words[:at], *words[at + 2:], *WARNINGS]


def compiled(unit):
    environment = {"NODE_PATH": "/usr/share/nodejs", **os.environ}
    words = syntax_only(unit["command"])
    done = subprocess.run(words, cwd=unit["directory"], env=environment, capture_output=True, text=True)
    return "" if done.returncode == 0 else done.stderr


def main(build):
    folders = tuple(f"{ROOT}/{folder}/" for folder in ("beeline", "cli", "web"))
    units = [unit for unit in compile_units(build) if unit["file"].startswith(folders) or is_unity(unit["file"])]
    version = subprocess.run(["em++", "--version"], capture_output=True, check=True).stdout
    settings = version + " ".join(WARNINGS).encode()
    return int(check_units("warnings of the page's compiler", units, settings, compiled))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1]))
