"""Counts the instructions of a single call with valgrind's callgrind, which knows AVX2 at most. The
counts do not depend on what else the machine does.

Usage: count.py PROGRAM FILE.json"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path


CASES = {
    "forward": ("puma560", "ur5", "panda", "iiwa14"),
    "jacobian": ("puma560", "ur5", "panda", "iiwa14"),
    "batch": ("ur5", "panda"),
    "batch-float": ("panda",),
    "all-solutions": ("puma560", "ur5", "general_6r", "panda_q7"),
    "numerical": ("panda", "ur5"),
    "tracking": ("panda",),
}


def count(program, case, arm):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "callgrind.out"
        run = subprocess.run(["valgrind", "--tool=callgrind", "--toggle-collect=*counted_calls*",
                              f"--callgrind-out-file={out}", program, case, arm],
                             capture_output=True, text=True, check=True)
        total = re.search(r"^(?:summary|totals): (\d+)", out.read_text(), re.MULTILINE)
    return int(total[1]) / int(run.stdout)


def main(program, path):
    counts = {}
    print("| case | arm | instructions a call |\n|---|---|---|")
    for case, arms in CASES.items():
        for arm in arms:
            counts[f"{case} / {arm}"] = count(program, case, arm)
            print(f"| {case} | {arm} | {counts[f'{case} / {arm}']:.0f} |", flush=True)
    Path(path).write_text(json.dumps(counts, indent=1) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
