"""Compares what was measured with what is stored, and exits with 1 where Beeline lost: where it takes
more than 2 % more instructions, or where its time against a peer's is more than 20 % longer even with
the spread of the repetitions, now and when the baseline was stored, in its favour. On a busy machine
the spread is wide, and only the instructions tell small losses.

Usage: baseline.py check|store RESULTS.json INSTRUCTIONS.json BASELINE.json"""

import json
import sys
from pathlib import Path

MAX_RATIO = 1.2
MAX_INSTRUCTIONS = 1.02


def named(results, value):
    return {f"{r['name']} / {r['arm']} / {r['peer']}": value(r) for r in results}


def ratios(results):
    """{"name / arm / peer": Beeline's time over the peer's}"""
    return named(results, lambda r: r.get("ratio_inside", r["ratio"]))


def spreads(results):
    """The interquartile ranges of both times, over their medians."""
    return named(results, lambda r: r.get("spread", 0.0))


def longer(now, before):
    """Where the time against a peer's is longer beyond the spread, and how often it is not beyond."""
    found, unsure = [], 0
    for key, stored in sorted(before["ratios"].items()):
        ratio, spread = now["ratios"].get(key, 0.0), now["spreads"].get(key, 0.0)
        if ratio <= MAX_RATIO * stored:
            continue
        if ratio > MAX_RATIO * stored * (1 + spread) * (1 + before.get("spreads", {}).get(key, 0.0)):
            found.append(f"{key}: ratio {ratio:.4g} (spread {100 * spread:.0f} %), {ratio / stored:.2f} "
                         f"times the baseline's {stored:.4g}")
        else:
            unsure += 1
    return found, unsure


def more_instructions(now, before):
    return [f"{key}: {now[key]:.0f} instructions, {now[key] / before[key]:.3f} times the baseline's "
            f"{before[key]:.0f}"
            for key in sorted(before.keys() & now.keys())
            if now[key] > MAX_INSTRUCTIONS * before[key]]


def main(word, results, instructions, baseline):
    measured = json.loads(Path(results).read_text())
    now = {"ratios": ratios(measured), "spreads": spreads(measured),
           "instructions": json.loads(Path(instructions).read_text())}
    if word == "store":
        Path(baseline).write_text(json.dumps(now, indent=1, sort_keys=True) + "\n")
        return 0
    before = json.loads(Path(baseline).read_text())
    slower, unsure = longer(now, before)
    lost = slower + more_instructions(now["instructions"], before["instructions"])
    print("\n".join(lost) if lost else
          f"Nothing lost against the baseline: {len(now['ratios'])} ratios, "
          f"{len(now['instructions'])} instruction counts")
    if unsure:
        print(f"{unsure} ratios are worse by no more than their spread")
    return int(bool(lost))


if __name__ == "__main__":
    if len(sys.argv) != 5 or sys.argv[1] not in ("check", "store"):
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
