"""Prints a table of Google Benchmark's results and adds it to results.json.

Usage: report.py RESULTS.json MEASURED.json..., written with --benchmark_repetitions and
--benchmark_out; names are arm/case/solver. A solver's time is the median of its repetitions."""

import json
import sys
from collections import defaultdict
from pathlib import Path


def medians(paths):
    """{(arm, case): {solver: nanoseconds}}"""
    found = defaultdict(dict)
    for path in paths:
        for run in json.loads(Path(path).read_text())["benchmarks"]:
            if run.get("aggregate_name") != "median":
                continue
            arm, case, solver = run["run_name"].split("/")[:3]
            scale = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}[run["time_unit"]]
            found[arm, case][solver] = run.get("each_ns", run["real_time"] * scale)
    return found


def main(results_path, *paths):
    found = medians(paths)
    path = Path(results_path)
    results = json.loads(path.read_text()) if path.exists() else []
    results = [old for old in results if (old["arm"], old["name"]) not in found]
    print("| case | arm | Beeline ns | peer | peer ns | peer / Beeline |\n|---|---|---|---|---|---|")
    for (arm, case), times in sorted(found.items(), key=lambda item: item[0][::-1]):
        ours = times.pop("Beeline")
        for peer, theirs in times.items() or [("", None)]:
            cells = [case, arm, f"{ours:.1f}", peer,
                     *(["", ""] if theirs is None else [f"{theirs:.0f}", f"{theirs / ours:.1f}"])]
            print("| " + " | ".join(cells) + " |")
            if theirs is not None:
                results.append({"name": case, "arm": arm, "beeline_ns": ours, "peer": peer,
                                "peer_ns": theirs, "ratio": ours / theirs})
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
