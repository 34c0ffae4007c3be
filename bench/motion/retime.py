"""Time-optimal scaling along splines: Beeline and toppra on the same paths, limits and grids.

Usage: retime.py BENCH_RETIME [--count N] [--seed S]

Prints a table in Markdown. The first two rows are on a grid of 101 even points for both; the third
leaves the grid to each. A duration's ratio is Beeline's by toppra's; `share` is the largest share
of a limit that either uses at ten places of every step.
"""

import argparse
import logging
import subprocess
import sys
import time

import numpy

logging.disable(logging.WARNING)
try:
    import toppra
    from toppra.algorithm import TOPPRA
    from toppra.constraint import JointAccelerationConstraint, JointVelocityConstraint
except ImportError:
    sys.exit("Left out: toppra is not installed")

PANDA = ([2.175] * 4 + [2.61] * 3, [15, 7.5, 10, 12.5, 15, 20, 20])
UR5 = ([3.14] * 7, [4.0] * 7)


def random_case(random, joints, count):
    velocity, acceleration = PANDA if random.random() < 0.5 else UR5
    waypoints = random.uniform(-1.5, 1.5, (count, joints))
    chords = numpy.linalg.norm(numpy.diff(waypoints, axis=0), axis=1)
    parameter = numpy.concatenate([[0], numpy.cumsum(chords)])
    return (numpy.array(velocity[:joints], float), numpy.array(acceleration[:joints], float),
            parameter, waypoints)


def beeline(process, case, grid):
    velocity, acceleration, parameter, waypoints = case
    head = [len(velocity), len(parameter), len(grid)]
    parts = (head, velocity, acceleration, parameter, waypoints.ravel(), grid)
    process.stdin.write(numpy.concatenate(parts).astype(float).tobytes())
    process.stdin.flush()
    return numpy.frombuffer(process.stdout.read(4 * 8))  # duration, share, points, microseconds


def share_used(spline, s, speed, velocity, acceleration):
    b, largest = speed**2, 0
    for part in numpy.linspace(0, 1, 11):
        at, u = s[:-1] + part * numpy.diff(s), numpy.diff(b) / (2 * numpy.diff(s))
        between = (b[:-1] + part * numpy.diff(b))[:, None]
        moved = numpy.abs(spline(at, 1)) * numpy.sqrt(between) / velocity
        pushed = numpy.abs(spline(at, 1) * u[:, None] + spline(at, 2) * between) / acceleration
        largest = max(largest, moved.max(), pushed.max())
    return largest


def peer(case, grid):
    velocity, acceleration, parameter, waypoints = case
    spline = toppra.SplineInterpolator(parameter, waypoints)
    best = numpy.inf
    for _ in range(5):
        begin = time.perf_counter()
        solver = TOPPRA(
            [JointVelocityConstraint(velocity), JointAccelerationConstraint(acceleration)],
            spline, gridpoints=grid if len(grid) else None, solver_wrapper="seidel")
        speed = solver.compute_parameterization(0, 0)[1]
        best = min(best, time.perf_counter() - begin)
    s = solver.gridpoints
    duration = numpy.sum(2 * numpy.diff(s) / (speed[1:] + speed[:-1]))
    share = share_used(spline, s, speed, velocity, acceleration)
    return numpy.array([duration, share, len(s), 1e6 * best])


def row(title, process, cases, even_grid):
    ours, theirs = [], []
    for case in cases:
        grid = numpy.linspace(0, case[2][-1], 101) if even_grid else numpy.zeros(0)
        ours.append(beeline(process, case, grid))
        theirs.append(peer(case, grid))
    ours, theirs = numpy.array(ours), numpy.array(theirs)
    ratio, faster = ours[:, 0] / theirs[:, 0], theirs[:, 3] / ours[:, 3]
    print(f"| {title} | {numpy.median(ours[:, 3]):.1f} | {numpy.median(theirs[:, 3]):.0f} "
          f"| {faster.min():.0f} to {faster.max():.0f} "
          f"| {numpy.median(ratio):.4f}, at most {ratio.max():.4f} "
          f"| {ours[:, 1].max():.4f} | {theirs[:, 1].max():.4f} "
          f"| {ours[:, 2].mean():.0f} | {theirs[:, 2].mean():.0f} |", flush=True)


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("program")
    options.add_argument("--count", type=int, default=200)
    options.add_argument("--seed", type=int, default=1)
    options = options.parse_args()
    random = numpy.random.default_rng(options.seed)
    process = subprocess.Popen([options.program], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    print("| paths | Beeline µs | toppra µs | times faster | duration by toppra's "
          "| share | toppra's share | points | toppra's points |")
    print("|---|---|---|---|---|---|---|---|---|")
    seven = [random_case(random, 7, 6) for _ in range(options.count)]
    sizes = random.integers((1, 3), (8, 11), (options.count, 2))
    any_size = [random_case(random, *size) for size in sizes]
    row("7 joints, 6 waypoints, 101 even points", process, seven, True)
    row("1 to 7 joints, 3 to 10 waypoints, 101 even points", process, any_size, True)
    row("1 to 7 joints, 3 to 10 waypoints, each its own grid", process, any_size, False)
    process.stdin.close()
    sys.exit(process.wait())


if __name__ == "__main__":
    main()
