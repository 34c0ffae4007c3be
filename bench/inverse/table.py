"""Merges what bench_inverse and peers.py measured: prints Markdown tables, writes results.json.

Usage: table.py FOLDER, with a folder an arm"""

import json
import statistics
import sys
from collections import defaultdict
from pathlib import Path

ARMS = ["puma560", "ur5", "stanford", "general_6r", "panda", "iiwa14", "panda_q7", "iiwa14_q7"]
CASES = {
    "all solutions": "All solutions, limits ignored (`_q7`: the last joint given)",
    "within limits": "One solution within limits",
    "numerical, within limits": "The numerical solver alone, within limits",
    "numerical, limits ignored": "The numerical solver alone, limits ignored",
    "tracking": "Tracking: from a seed within 0.1 rad",
}
# What a peer is measured against where it was asked another case's question.
ALSO = {"numerical, within limits": "within limits"}
NOTES = """
Times in microseconds a call, means in CPU time. `less the wrapper`: of a peer called from Python, what is left of the
mean without a call that does almost nothing; the last column compares with that. `solved`: share
of poses reached to 1e-6 (m, rad), and within limits where these count; `solutions`: right ones
a pose that differ by more than 1e-4; `wrong`: configurations that the solver called solutions and
that are none. KDL knows no limits, and none are asked of it; it and TRAC-IK start in the middle of
the limits, Robotics Toolbox at random. TRAC-IK races two threads, here on one core."""
COLUMNS = ["arm", "solver", "mean µs", "less the wrapper", "median", "p99", "p99.9", "max", "solved",
           "solutions", "wrong", "worst error", "Beeline / peer"]
HEAD = f"| {' | '.join(COLUMNS)} |\n|{'---|' * len(COLUMNS)}"


def load(folder):
    """The records of all rounds, with the records of one arm, case and solver merged."""
    rounds, left_out = defaultdict(list), {}
    for arm in ARMS:
        for path in [*sorted((folder / arm).glob("native.*.jsonl")),
                     *sorted((folder / arm).glob("peers.*.jsonl"))]:
            for line in path.read_text().splitlines():
                record = json.loads(line)
                if "left_out" in record:
                    left_out[record["left_out"]] = record["why"]
                else:
                    rounds[arm, record["case"], record["solver"]].append(record)
    return [merged(records) for records in rounds.values()], left_out


def merged(records):
    """Over the rounds: the median of the mean and of the wrapper, the least of the percentiles, which
    interruptions lengthen; `spread` is the range of the mean, over its median."""
    times = {key: (statistics.median if key in ("mean_us", "wrapper_us") else min)(
                 record[key] for record in records)
             for key in records[0] if key.endswith("_us")}
    means = [inside(record) for record in records]
    median = max(statistics.median(means), 1e-9)
    return {**records[0], **times, "spread": (max(means) - min(means)) / median}


def microseconds(value):
    return f"{value:.3f}" if value < 10 else f"{value:.1f}" if value < 1000 else f"{value:.0f}"


def inside(record):
    """The mean without what the call from Python costs."""
    if "wrapper_us" not in record:
        return record["mean_us"]
    return max(0.0, record["mean_us"] - record["wrapper_us"])


def row(record, ours):
    beeline = record["solver"] == "Beeline"
    times = [record[key] for key in ("median_us", "p99_us", "p999_us", "max_us")]
    ratio = "" if beeline or not ours else f"{ours['mean_us'] / inside(record):.3f}"
    name = record["solver"]
    if "version" in record:
        name += f" {record['version']}"
    if record.get("poses", 0) and record["poses"] != ours.get("poses"):
        name += f", {record['poses']} poses"
    worst = f"{record['worst_error']:.0e}"
    if not record["solved"] and "nearest_error" in record:
        worst = f"nearest {record['nearest_error']:.0e}"
    cells = [record["arm"], f"**{name}**" if beeline else name, microseconds(record["mean_us"]),
             "" if "wrapper_us" not in record else microseconds(inside(record)),
             *map(microseconds, times), f"{100 * record['solved']:.2f} %",
             f"{record['solutions']:.2f}", str(record["wrong"]), worst, ratio]
    return "| " + " | ".join(cells) + " |"


def result(case, record, ours):
    return {"name": case, "arm": record["arm"], "beeline_ns": 1000 * ours["mean_us"],
            "beeline_p999_ns": 1000 * ours["p999_us"], "beeline_solved": ours["solved"],
            "beeline_solutions": ours["solutions"], "beeline_wrong": ours["wrong"],
            "beeline_worst_error": ours["worst_error"], "peer": record["solver"],
            "spread": ours["spread"] + record["spread"],
            "peer_ns": 1000 * record["mean_us"], "peer_inside_ns": 1000 * inside(record),
            "ratio": ours["mean_us"] / record["mean_us"],
            "ratio_inside": ours["mean_us"] / max(inside(record), 1e-9),
            "peer_solved": record["solved"], "peer_solutions": record["solutions"],
            "peer_wrong": record["wrong"], "peer_worst_error": record["worst_error"]}


def main(folder):
    records, left_out = load(folder)
    results = []
    for case, title in CASES.items():
        lines = []
        for arm in ARMS:
            ours = [r for r in records if r["arm"] == arm and r["case"] == case
                    and r["solver"] == "Beeline"]
            if not ours:
                continue
            asked = (case, ALSO.get(case))
            peers = [r for r in records if r["arm"] == arm and r["case"] in asked
                     and r["solver"] != "Beeline"]
            lines += [row(record, ours[0]) for record in [*ours, *peers]]
            results += [result(case, peer, ours[0]) for peer in peers]
        if lines:
            print(f"\n### {title}\n\n{HEAD}")
            print("\n".join(lines))
    print(NOTES)
    for name, why in left_out.items():
        print(f"\nLeft out: {name} ({why})")
    (folder / "results.json").write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
