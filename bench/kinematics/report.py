"""Prints a table of Google Benchmark's results and adds it to results.json.

Usage: report.py RESULTS.json MEASURED.json..., written with --benchmark_repetitions,
--benchmark_enable_random_interleaving and --benchmark_out; names are arm/case/solver. A solver's time
is the median CPU time of its repetitions, `spread` the interquartile range over the median, added up
over the two solvers of a ratio."""

import json
import statistics
import sys
from collections import defaultdict
from pathlib import Path


def measured(paths):
    """{(arm, case): {solver: (nanoseconds, spread)}}"""
    times = defaultdict(lambda: defaultdict(list))
    for path in paths:
        for run in json.loads(Path(path).read_text())["benchmarks"]:
            if run["run_type"] != "iteration":
                continue
            arm, case, solver = run["run_name"].split("/")[:3]
            scale = {"ns": 1, "us": 1e3, "ms": 1e6, "s": 1e9}[run["time_unit"]]
            times[arm, case][solver].append(run.get("each_ns", run["cpu_time"] * scale))
    return {key: {solver: median_and_spread(runs) for solver, runs in solvers.items()}
            for key, solvers in times.items()}


def median_and_spread(times):
    median = statistics.median(times)
    if len(times) < 2:
        return median, 0.0
    quartiles = statistics.quantiles(times, n=4, method="inclusive")
    return median, (quartiles[2] - quartiles[0]) / median


def main(results_path, *paths):
    found = measured(paths)
    path = Path(results_path)
    results = json.loads(path.read_text()) if path.exists() else []
    results = [old for old in results if (old["arm"], old["name"]) not in found]
    print("| case | arm | Beeline ns | peer | peer ns | peer / Beeline |\n|---|---|---|---|---|---|")
    for (arm, case), times in sorted(found.items(), key=lambda item: item[0][::-1]):
        ours, our_spread = times.pop("Beeline")
        for peer, (theirs, their_spread) in times.items() or [("", (None, 0.0))]:
            cells = [case, arm, f"{ours:.1f}", peer,
                     *(["", ""] if theirs is None else [f"{theirs:.0f}", f"{theirs / ours:.1f}"])]
            print("| " + " | ".join(cells) + " |")
            if theirs is not None:
                results.append({"name": case, "arm": arm, "beeline_ns": ours, "peer": peer,
                                "peer_ns": theirs, "ratio": ours / theirs,
                                "spread": our_spread + their_spread})
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
