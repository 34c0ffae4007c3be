#!/usr/bin/env python3
"""The confusion matrix of `beeline check` on trajectories made by other means.

    python3 tests/peers/check_confusion.py build/beeline [seed] [files]

Half of the files are faulty, half of these by less than 5 % beyond a limit or the tolerance. They
are made by dense inverse kinematics with finite differences, by hand (quintic and cubic samples),
and, where they are installed, by Ruckig and TOPP-RA. The truth is an evaluation of its own: forward
kinematics from DH tables, the polynomials that the columns mean, at 40 times between samples.
"""

import json
import os
import subprocess
import sys
import tempfile

import numpy as np

from motion_truth import (ARMS, PI, TOLERANCE, File, Line, limit_fractions, path_error, rotation,
                          rotation_vector, slowest, truth)

try:
    import ruckig
except ImportError:
    ruckig = None
try:
    import toppra
except ImportError:
    toppra = None

# Time laws: s, ds, dds at times from 0 to 1.

def quintic_law(u):
    return 10 * u**3 - 15 * u**4 + 6 * u**5, 30 * u**2 * (1 - u)**2, 60 * u * (1 - 3 * u + 2 * u**2)


def ruckig_law(u):
    otg, given = ruckig.Ruckig(1), ruckig.InputParameter(1)
    given.target_position, given.max_velocity = [1.0], [1.6]
    given.max_acceleration, given.max_jerk = [9.0], [120.0]
    made = ruckig.Trajectory(1)
    otg.calculate(given, made)
    rows = np.array([np.ravel(made.at_time(x * made.duration)) for x in u])
    return rows[:, 0], rows[:, 1] * made.duration, rows[:, 2] * made.duration**2


def toppra_rows(line, arm, count):
    """Positions, velocities and accelerations by TOPP-RA at even times, and the duration."""
    toppra.setup_logging("ERROR")
    grid = np.linspace(0, 1, 60)
    path = toppra.SplineInterpolator(grid, line.joints(grid))
    velocity = np.stack([-arm.limits[:, 0], arm.limits[:, 0]], -1)
    acceleration = np.stack([-arm.limits[:, 1], arm.limits[:, 1]], -1)
    made = toppra.algorithm.TOPPRA(
        [toppra.constraint.JointVelocityConstraint(velocity),
         toppra.constraint.JointAccelerationConstraint(acceleration)],
        path, parametrizer="ParametrizeConstAccel").compute_trajectory(0, 0)
    t = np.linspace(0, made.duration, count)
    q, v, a = made(t), made(t, 1), made(t, 2)
    q[0], q[-1] = line.joints(np.array([0., 1.]))
    v[[0, -1]] = 0
    return q, v, a, made.duration


def make_motion(rng, arm):
    """One or two lines, and a good file along them, at most 97 % of the limits."""
    while True:
        q, lines = arm.home + 0.2 * rng.standard_normal(len(arm.home)) * (np.arange(len(arm.home)) != 2), []
        for _ in range(rng.integers(1, 3)):
            goal = arm.fk(q)[0]
            size = 1.5 if arm.planar else 0.15
            step = size * (rng.random(3) - 0.5) * ([1, 1, 0] if arm.planar else [1, 1, 1])
            turn = 0.3 * (rng.random(3) - 0.5) * ([0, 0, 1] if arm.planar else [1, 1, 1])
            goal[:3, 3] += step
            goal[:3, :3] = rotation(turn) @ goal[:3, :3]
            lines.append(Line(arm, q, goal))
            q = lines[-1].last
        s = np.linspace(0, 1, 50)
        error = max(path_error(arm, [line], line.joints(s))[0].max() for line in lines)
        if error < 1e-10 and all(np.linalg.norm(line.d) > 0.2 * size for line in lines):
            break
    makers = ["finite differences", "by hand"] + ["ruckig"] * (ruckig is not None) + ["toppra"] * (toppra is not None)
    maker = makers[rng.integers(len(makers))]
    columns = rng.integers(1, 4)
    count = int(rng.integers(60, 120) if maker == "by hand" else rng.integers(250, 500))
    parts, t0 = [], 0.0
    for line in lines:
        u = np.linspace(0, 1, count)
        if maker == "toppra":
            q, v, a, duration = toppra_rows(line, arm, count)
        else:
            q, v, a = line.motion(*(ruckig_law if maker == "ruckig" else quintic_law)(u))
            duration = 1.0
            if maker == "finite differences":
                v = np.gradient(q, u[1], axis=0)
                v[[0, -1]] = 0
                a = np.gradient(v, u[1], axis=0)
                a[[0, -1]] = 0
        # Each part as slow as its own limits need, so that the whole uses them.
        part = File(u * duration, q, v if columns > 1 else None, a if columns > 2 else None)
        part = part.slower(slowest(limit_fractions(arm, part, part.dense(8)[1])))
        first = 0 if not parts else 1
        parts.append(File(t0 + part.t[first:], part.q[first:], None if part.v is None else part.v[first:],
                          None if part.a is None else part.a[first:]))
        t0 = parts[-1].t[-1]
    join = lambda name: None if getattr(parts[0], name) is None else np.concatenate([getattr(p, name) for p in parts])
    file = File(join("t"), join("q"), join("v"), join("a"))
    return lines, to_fraction(arm, file, rng.uniform(0.8, 0.97)), maker


def to_fraction(arm, file, fraction):
    """Scaled in time such that the binding limit is used to this fraction; on whole nanoseconds."""
    use = limit_fractions(arm, file, file.dense()[1])
    order = 1 + np.argmax(use ** (1 / np.arange(1, 4)))
    return file.slower((use[order - 1] / fraction) ** (1 / order))


def bumped(arm, lines, file, excess, rng):
    """Off the path in the middle by 1 + excess of the tolerance."""
    T = file.t[-1]
    x = np.clip((file.t / T - 0.35) / 0.3, 0, 1)
    b = 64 * (x * (1 - x))**3
    db = 64 * 3 * (x * (1 - x))**2 * (1 - 2 * x) / (0.3 * T)
    ddb = 64 * (6 * x * (1 - x) * (1 - 2 * x)**2 - 6 * (x * (1 - x))**2) / (0.3 * T)**2
    way = rng.standard_normal(file.q.shape[1])

    def off(size):
        changed = file.copy()
        changed.q = file.q + size * b[:, None] * way
        if file.v is not None:
            changed.v = file.v + size * db[:, None] * way
        if file.a is not None:
            changed.a = file.a + size * ddb[:, None] * way
        return changed

    low, high = 0, 1e-2
    for _ in range(40):
        middle = (low + high) / 2
        error = path_error(arm, lines, off(middle).dense(10)[1][0])[0].max()
        low, high = (middle, high) if error < (1 + excess) * TOLERANCE else (low, middle)
    return off(high)


def faulty(rng, arm, lines, file):
    """A file with a planted fault; small ones are less than 5 % beyond a limit or tolerance."""
    small, gross = rng.uniform(0.002, 0.049), rng.uniform(0.1, 2)
    kind = ["limit", "deviation", "limit!", "deviation!", "pause", "cut", "columns", "sample", "end", "end!", "back"][rng.integers(11)]
    if kind.startswith("limit"):
        return kind, to_fraction(arm, file, 1 + (gross if kind.endswith("!") else small))
    if kind.startswith("deviation"):
        return kind, bumped(arm, lines, file, gross if kind.endswith("!") else small, rng)
    bad, k = file.copy(), len(file.t) // 3
    rows = lambda x, pick: None if x is None else x[pick]
    if kind == "pause":
        pick = np.sort(np.append(np.arange(len(file.t)), k))
        bad = File(file.t[pick], file.q[pick], rows(file.v, pick), rows(file.a, pick))
        bad.t[k + 1:] += rng.uniform(0.01, 1)
    elif kind == "cut":
        bad = File(file.t[k:] - file.t[k], file.q[k:], rows(file.v, slice(k, None)), rows(file.a, slice(k, None)))
    elif kind == "columns" and file.v is not None:
        which = bad.v if file.a is None or rng.random() < 0.5 else bad.a
        which *= [0, -1, 1 + gross][rng.integers(3)]
    elif kind == "sample":
        which = bad.q if file.v is None else [bad.q, bad.v, bad.a if bad.a is not None else bad.v][rng.integers(3)]
        which[k] += rng.choice([1e-4, 1e-2]) * rng.standard_normal(which.shape[1])
    elif kind.startswith("end"):
        # The motion to a point short of the end, by a shift of all of the last part.
        short = lines[-1].pose(1 - (1 + (gross if kind.endswith("!") else small)) * TOLERANCE / np.linalg.norm(lines[-1].d))
        change = arm.ik(short, file.q[-1]) - file.q[-1]
        x = np.clip((file.t / file.t[-1] - 0.7) / 0.3, 0, 1)
        bad.q = file.q + (x**3 * (10 - 15 * x + 6 * x * x))[:, None] * change
        T = 0.3 * file.t[-1]
        if bad.v is not None:
            bad.v = file.v + (30 * x**2 * (1 - x)**2 / T)[:, None] * change
        if bad.a is not None:
            bad.a = file.a + (60 * x * (1 - 3 * x + 2 * x * x) / T**2)[:, None] * change
    elif kind == "back":
        line, n = lines[0], 400
        u = np.linspace(0, 1, n)
        back = (1 + rng.choice([small, 5 * gross])) * TOLERANCE / np.linalg.norm(line.d)
        third = (quintic_law(u)[0] * 0.5, 0.5 - back * quintic_law(u)[0], 0.5 - back + (0.5 + back) * quintic_law(u)[0])
        s = np.concatenate([third[0], third[1][1:], third[2][1:]])
        q = line.joints(s)
        bad = to_fraction(arm, File(np.linspace(0, 3, len(s)), q, None, None), 0.5)
        return kind + ("" if len(lines) == 1 else " of the first line"), bad
    return kind, bad


def write(arm, lines, file, folder):
    names = [f"joint{i + 1}" for i in range(file.q.shape[1])]
    blocks = [(file.q, ""), (file.v, "_vel"), (file.a, "_acc")]
    header = ["t"] + [n + ending for x, ending in blocks if x is not None for n in names]
    table = np.hstack([file.t[:, None]] + [x for x, _ in blocks if x is not None])
    with open(os.path.join(folder, "m.csv"), "w") as out:
        out.write(",".join(header) + "\n" + "".join(",".join(repr(float(x)) for x in row) + "\n" for row in table))
    with open(os.path.join(folder, "w.csv"), "w") as out:
        out.write("x,y,theta\n" if arm.planar else "x,y,z,qw,qx,qy,qz\n")
        for line in lines:
            x, y, z = line.end[:3, 3]
            v = rotation_vector(line.end[:3, :3])
            half = np.linalg.norm(v) / 2
            unit = np.sinc(half / PI) / 2 * v
            row = [x, y, v[2]] if arm.planar else [x, y, z, np.cos(half), *unit]
            out.write(",".join(repr(float(value)) for value in row) + "\n")


def main():
    beeline, seed = os.path.abspath(sys.argv[1]), int(sys.argv[2]) if len(sys.argv) > 2 else 1
    total = int(sys.argv[3]) if len(sys.argv) > 3 else 200
    rng = np.random.default_rng(seed)
    print(f"seed {seed}; ruckig {'yes' if ruckig else 'no'}, toppra {'yes' if toppra else 'no'}")
    wanted = {"good": total // 2, "small": total // 4, "gross": total - total // 2 - total // 4}
    matrix, makers = {(c, a): 0 for c in wanted for a in ("passed", "failed")}, {}
    with tempfile.TemporaryDirectory() as folder:
        while any(wanted.values()):
            arm = ARMS[rng.integers(len(ARMS))]
            lines, file, maker = make_motion(rng, arm)
            kind = "good"
            if wanted["small"] or wanted["gross"] and rng.random() < 0.7:
                kind, file = faulty(rng, arm, lines, file)
            elif rng.random() < 0.3:
                kind, file = "nearly off", bumped(arm, lines, file, -rng.uniform(0.02, 0.3), rng)
            file.t = np.round(file.t * 1e9) / 1e9
            excess, cause = truth(arm, lines, file)
            label = "good" if excess <= 0 else "small" if excess < 0.05 else "gross"
            if not wanted[label]:
                continue
            wanted[label] -= 1
            makers[maker] = makers.get(maker, 0) + 1
            write(arm, lines, file, folder)
            done = subprocess.run([beeline, "check", arm.name, "m.csv", "--through", "w.csv", "--json"],
                                  cwd=folder, capture_output=True, text=True)
            answer = json.loads(done.stdout) if done.stdout else {"status": "failed", "reason": done.stderr}
            matrix[label, answer["status"]] += 1
            if (answer["status"] == "passed") != (label == "good"):
                print(f"  {answer['status']} but {label}: {arm.name}, {maker}, {file.order()} columns, {kind}; truth {cause} "
                      f"{excess:+.2%}; {answer['reason'][:150]}")
    print("made by " + ", ".join(f"{name}: {count}" for name, count in sorted(makers.items())))
    print("truth                          passed  failed")
    for label, text in (("good", "within limits and tolerance"), ("small", "beyond by less than 5 %"), ("gross", "beyond by more")):
        print(f"{text:<30} {matrix[label, 'passed']:>6}  {matrix[label, 'failed']:>6}")
    wrong = matrix["good", "failed"] + matrix["small", "passed"] + matrix["gross", "passed"]
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
