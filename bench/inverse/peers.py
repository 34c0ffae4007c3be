"""Runs the Python peers on the problems of bench_inverse: the same poses, the same core.

Usage: peers.py FOLDER..., each as bench_inverse left it: gets peers.jsonl

A peer that cannot be imported is left out, and the reason stands in its place. Times are those that
the call from Python takes; the mean is CPU time, which other programs on the machine do not lengthen.
`wrapper_us` is what a call takes that does almost nothing beside handing its arguments over (the
peer's forward kinematics, as a rule): what is left of the mean without it is about the time
inside."""

import os

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[threads] = "1"

import argparse
import gc
import importlib
import json
import statistics
import time
from importlib.metadata import version
from pathlib import Path

import numpy as np
from description import TOLERANCE, Description

PEERS = ["peer_eaik", "peer_ik_geo", "peer_pytracik", "peer_toolbox"]
PATIENCE = 60  # seconds that a peer gets for one pass


def stay_on_one_core():
    core = int(os.environ.get("BENCH_CORE", max(os.sched_getaffinity(0))))
    os.sched_setaffinity(0, {core})


def clock_cost():
    costs = []
    for _ in range(1001):
        start = time.perf_counter_ns()
        costs.append(time.perf_counter_ns() - start)
    return statistics.median(costs)


def one_pass(ask, count):
    """Nanoseconds of each call, and of CPU time for all."""
    row = []
    begin = time.process_time_ns()
    for i in range(count):
        start = time.perf_counter_ns()
        ask(i)
        row.append(time.perf_counter_ns() - start)
    return row, time.process_time_ns() - begin


def nothing(_):
    pass


def timed(ask, count, passes):
    """Microseconds: of each call the shortest of all passes, less the clock's own cost; the mean call
    of the median pass in CPU time, less the time of a loop that calls nothing."""
    cost = clock_cost()
    empty = min(one_pass(nothing, 1000)[1] for _ in range(5)) / 1000
    rows, means = [], []
    for _ in range(passes):
        row, whole = one_pass(ask, count)
        rows.append(row)
        means.append(whole / count - empty)
        if whole > PATIENCE / 10 * 1e9:
            break
    best = np.maximum(0, np.min(rows, axis=0) - cost) / 1000
    return best, max(0.0, statistics.median(means) / 1000)


def poses_in_time(ask, count):
    """How many poses the peer can be asked in time."""
    few = min(count, 50)
    start = time.perf_counter()
    for i in range(few):
        ask(i)
    return min(count, max(few, int(PATIENCE * few / (time.perf_counter() - start))))


def distinct(rows):
    """How many of the configurations differ by more than 1e-4, whole turns aside."""
    kept = []
    for row in rows:
        if all(np.max(np.abs(np.remainder(row - k + np.pi, 2 * np.pi) - np.pi)) > 1e-4
               for k in kept):
            kept.append(row)
    return len(kept)


def checked(arm, limits, ask, read, count):
    """What came back, put through forward kinematics. `nearest_error`: of each pose the least error
    of all that came back, also of what the peer itself calls no solution; the median."""
    answers = [(i, q, claimed) for i in range(count) for q, claimed in read(ask(i))]
    if not answers:
        return {"solved": 0.0, "solutions": 0.0, "wrong": 0, "worst_error": 0.0}
    which = np.array([i for i, _, _ in answers])
    q = np.array([q for _, q, _ in answers], dtype=float)
    claimed = np.array([claimed for _, _, claimed in answers])
    errors = arm.errors(arm.poses[which], q)
    good = errors <= TOLERANCE
    if limits:
        good &= arm.within_limits(q)
    right = claimed & good
    rows = {i: [] for i in which}
    least = dict.fromkeys(rows, np.inf)
    for i, row, use, error in zip(which, q, right, errors):
        least[i] = min(least[i], error)
        if use:
            rows[i].append(row)
    return {"solved": sum(map(bool, rows.values())) / count,
            "solutions": sum(map(distinct, rows.values())) / count,
            "wrong": int(np.sum(claimed & ~good)),
            "worst_error": float(np.max(errors[right], initial=0)),
            "nearest_error": float(np.median(list(least.values())))}


def measured(arm, module, case, question, passes):
    ask, read, wrapper = question
    count = poses_in_time(ask, len(arm.poses))
    limits = case in ("within limits", "tracking")
    record = {"arm": arm.name, "case": case, "solver": module.SOLVER,
              "version": version(module.PACKAGE), "poses": count,
              **checked(arm, limits, ask, read, count)}
    best, mean = timed(ask, count, passes)
    record.update(mean_us=mean, median_us=float(np.median(best)),
                  p99_us=float(np.quantile(best, 0.99)), p999_us=float(np.quantile(best, 0.999)),
                  max_us=float(best.max()), wrapper_us=timed(wrapper, min(count, 2000), passes)[1])
    return record


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--passes", type=int, default=3)
    options = parser.parse_args()
    modules, left_out = [], []
    for name in PEERS:
        try:
            modules.append(importlib.import_module(name))
        except Exception as reason:  # whatever a broken installation throws
            left_out.append({"left_out": name.removeprefix("peer_"), "why": str(reason)})
    stay_on_one_core()
    gc.disable()  # its pauses are none of the peers'
    for folder in options.folders:
        arm = Description(folder)
        records = list(left_out)
        for module in modules:
            try:
                for case, question in module.questions(arm).items():
                    records.append(measured(arm, module, case, question, options.passes))
            except Exception as reason:
                records.append({"left_out": f"{module.SOLVER} on {arm.name}", "why": str(reason)})
            gc.collect()
        lines = [json.dumps(record) + "\n" for record in records]
        (folder / "peers.jsonl").write_text("".join(lines))


if __name__ == "__main__":
    main()
