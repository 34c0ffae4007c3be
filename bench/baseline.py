"""Compares what was measured with what is stored: says where Beeline lost more than 20 % against a
peer, or takes more than 2 % more instructions, and then exits with 1.

Usage: baseline.py check|store RESULTS.json INSTRUCTIONS.json BASELINE.json"""

import json
import sys
from pathlib import Path

MOST_LOST = 1.2
MOST_INSTRUCTIONS = 1.02


def ratios(results):
    """{"name / arm / peer": Beeline's time over the peer's}"""
    return {f"{r['name']} / {r['arm']} / {r['peer']}": r.get("ratio_inside", r["ratio"])
            for r in results}


def worse(now, before, most, what):
    return [f"{key}: {what} {now[key]:.4g}, {now[key] / before[key]:.2f} times the baseline's {before[key]:.4g}"
            for key in before if key in now and now[key] > most * before[key]]


def main(word, results, instructions, baseline):
    now = {"ratios": ratios(json.loads(Path(results).read_text())),
           "instructions": json.loads(Path(instructions).read_text())}
    if word == "store":
        Path(baseline).write_text(json.dumps(now, indent=1, sort_keys=True) + "\n")
        return 0
    before = json.loads(Path(baseline).read_text())
    lost = worse(now["ratios"], before["ratios"], MOST_LOST, "ratio")
    lost += worse(now["instructions"], before["instructions"], MOST_INSTRUCTIONS, "instructions")
    print("\n".join(lost) if lost else
          f"Nothing lost against the baseline: {len(now['ratios'])} ratios, "
          f"{len(now['instructions'])} instruction counts")
    return 1 if lost else 0


if __name__ == "__main__":
    if len(sys.argv) != 5 or sys.argv[1] not in ("check", "store"):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
