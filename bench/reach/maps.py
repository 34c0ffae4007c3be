"""Reach maps: cells a second on one and two threads beside EAIK on the same poses, efficiency of threads and MPI ranks, and
memory and time by the number of cells. Prints tables in Markdown.

Usage: maps.py [--mpi PROGRAM] BEELINE, such as maps.py --mpi build/beeline-reach-mpi build/beeline"""

import argparse
import json
import os
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import h5py
import numpy as np

try:
    from eaik.pybindings import EAIK
except ImportError:
    EAIK = None

ROUNDS = 3
# Positions a metre apart by so much, directions 30 degrees apart: 54, each with any roll.
ARMS = {"puma560": 0.05, "ur5": 0.05, "panda": 0.15, "iiwa14": 0.15}
REDUNDANT = {"panda": 6, "iiwa14": 2}  # the joint that takes 16 values
VALUES = 16
REULEAUX = 5200  # poses a second, published


def run(command):
    """Wall and CPU seconds and the largest memory, MB, of a command."""
    begin = time.perf_counter()
    process = subprocess.Popen([*map(str, command)], stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - begin
    if status != 0:
        raise RuntimeError(f"{command} ended with {status}")
    return wall, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def poses_of(cells, count, generator):
    """Random cells of a map: their poses and whether they are reached."""
    branches = cells["branches"]
    index = np.stack([generator.integers(n, size=count) for n in branches.shape], axis=1)
    poses = np.tile(np.eye(4), (count, 1, 1))
    z = cells["directions"][index[:, 3]]
    polar, azimuth = np.arctan2(np.hypot(z[:, 0], z[:, 1]), z[:, 2]), np.arctan2(z[:, 1], z[:, 0])
    c, s, ca, sa = np.cos(polar), np.sin(polar), np.cos(azimuth), np.sin(azimuth)
    poses[:, :3, 0] = np.stack([ca * c, sa * c, -s], axis=1)
    poses[:, :3, 1] = np.stack([-sa, ca, 0 * ca], axis=1)
    poses[:, :3, 2] = z
    for k, axis in enumerate("xyz"):
        poses[:, k, 3] = cells[axis][index[:, k]]
    return poses, branches[tuple(index.T)] > 0


def eaik_robots(beeline, arm):
    """EAIK's robots of an arm: one, or one for each value of the redundant joint."""
    joints = json.loads(subprocess.run([beeline, "show", arm, "--json"], capture_output=True, text=True).stdout)["joints"]
    zero = ",".join("0" * len(joints))
    home = np.array(json.loads(subprocess.run([beeline, "fk", arm, "--q", zero, "--json"], capture_output=True,
                                              text=True).stdout)["pose"]["matrix"])
    jacobian = np.array(json.loads(subprocess.run([beeline, "jacobian", arm, "--q", zero, "--frame", "space", "--json"],
                                                  capture_output=True, text=True).stdout)["jacobian"])
    axes = jacobian[3:].T
    points = np.cross(axes, jacobian[:3].T)  # nearest to the origin
    axes[np.abs(axes) < 1e-15] = points[np.abs(points) < 1e-15] = 0  # right angles, free from rounding
    offsets = np.diff(np.vstack([np.zeros(3), points, home[:3, 3]]), axis=0)
    locked = REDUNDANT.get(arm)
    if locked is None:
        return [EAIK.Robot(axes.T, offsets.T, home[:3, :3], [], True)]
    lower, upper = (joints[locked]["limits"][end] for end in ("lower", "upper"))
    values = lower + (upper - lower) * (np.arange(VALUES) + 0.5) / VALUES
    return [EAIK.Robot(axes.T, offsets.T, home[:3, :3], [(locked, value)], True) for value in values]


def beside_eaik(beeline, folder, generator):
    print("| arm | cells | Beeline, 1 thread | 2 threads | EAIK, 1 thread | 2 threads | Beeline / EAIK, 1 | 2 |")
    print("|---|---|---|---|---|---|---|---|")
    for arm, resolution in ARMS.items():
        out = folder / f"{arm}.h5"
        command = [beeline, "reach", "map", arm, "--resolution", resolution, "--out", out]
        rates = {"b1": [], "b2": [], "e1": [], "e2": []}
        for _ in range(ROUNDS):
            walls = {threads: run([*command, "--threads", threads])[0] for threads in (1, 2)}
            with h5py.File(out) as map:
                cells = {name: map[name][:] for name in ("branches", "x", "y", "z", "directions")}
            count = cells["branches"].size
            rates["b1"].append(count / walls[1])
            rates["b2"].append(count / walls[2])
            if EAIK is None:
                continue
            robots = eaik_robots(beeline, arm)
            poses, _ = poses_of(cells, 20_000 // len(robots), generator)
            batch = list(poses)
            for threads in (1, 2):
                begin = time.perf_counter()
                for robot in robots:
                    robot.calculate_IK_batched(batch, threads)
                rates[f"e{threads}"].append(len(batch) / (time.perf_counter() - begin))
        m = {key: statistics.median(values) if values else float("nan") for key, values in rates.items()}
        print(f"| {arm} | {count} | {m['b1']:,.0f} | {m['b2']:,.0f} | {m['e1']:,.0f} | {m['e2']:,.0f} | "
              f"{m['b1'] / m['e1']:.1f} | {m['b2'] / m['e2']:.1f} |", flush=True)


def efficiency(beeline, mpi, folder):
    print("\n| | seconds | CPU seconds | speedup | efficiency |")
    print("|---|---|---|---|---|")
    arm = ["ur5", "--resolution", "0.05"]
    work = {f"{n} thread{'s' * (n > 1)}": [beeline, "reach", "map", *arm, "--threads", n] for n in (1, 2)}
    for ranks in (1, 2, 4) if mpi else ():
        work[f"{ranks} rank{'s' * (ranks > 1)}"] = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", ranks, mpi,
                                                    "map", *arm, "--threads", 1]
    measured = {name: [] for name in work}
    for _ in range(ROUNDS):
        for name, command in work.items():
            measured[name].append(run([*command, "--out", folder / "ur5.h5"])[:2])
    single = {}
    for name, values in measured.items():
        wall, cpu = (statistics.median(column) for column in zip(*values, strict=True))
        count, kind = int(name.split()[0]), name.split()[1].rstrip("s")
        single.setdefault(kind, wall)
        speedup = single[kind] / wall
        print(f"| {name} | {wall:.2f} | {cpu:.2f} | {speedup:.2f} | {100 * speedup / min(count, os.cpu_count()):.0f} % |",
              flush=True)


def growth(beeline, folder):
    print("\n| ur5 | cells | stored | seconds | cells/s | memory, MB | file, MB | bytes a cell |")
    print("|---|---|---|---|---|---|---|---|")
    turned = ["--azimuths", "0.174533", "--rolls", "0.523599"]
    for name, options in (("directions", []), ("azimuths and rolls", turned)):
        for resolution in (0.1, 0.05, 0.025) + ((0.0125,) if options else ()):
            out = folder / "ur5.h5"
            wall, _, memory = run([beeline, "reach", "map", "ur5", "--resolution", resolution, *options, "--out", out])
            totals = json.loads(subprocess.run([beeline, "reach", "query", out, "--json"], capture_output=True,
                                               text=True).stdout)
            cells, size = totals["cells"], out.stat().st_size
            stored = cells // (36 * 12) if options else cells
            print(f"| {name} | {cells:,} | {stored:,} | {wall:.1f} | {cells / wall:,.0f} | {memory:.0f} | {size / 1e6:.2f} | "
                  f"{size / cells:.3f} |", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("beeline")
    parser.add_argument("--mpi")
    arguments = parser.parse_args()
    print(f"Reuleaux, published: {REULEAUX} poses a second. Median of {ROUNDS} rounds; cells, or poses, a second.\n")
    with tempfile.TemporaryDirectory() as folder:
        beside_eaik(arguments.beeline, Path(folder), np.random.default_rng(1))
        efficiency(arguments.beeline, arguments.mpi, Path(folder))
        growth(arguments.beeline, Path(folder))


if __name__ == "__main__":
    main()
