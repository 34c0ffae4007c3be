"""Beeline beside ssik, EAIK and IK-Geo on the arms that ssik brings along, all called from Python: Markdown tables.

Usage: market.py [--poses 100] [--arms NAME...] [--seed 1]

Poses come from random configurations, joint limits ignored. Each answer is put through forward kinematics of its own. Of
arms with six joints or fewer all solutions are asked; `missed` are right solutions that another solver found. Arms with
seven joints have infinitely many: one is asked."""

import argparse
import importlib
import pkgutil
import statistics
import time
from collections import defaultdict

import beeline
import numpy as np
import ssik.prebuilt
from description import TOLERANCE, meeting_point
from eaik.pybindings import EAIK
from ik_geo import Robot

APART = 1e-4  # rad, between two solutions
SOLVERS = ["Beeline", "ssik", "EAIK", "IK-Geo"]


class MarketArm:
    """One of ssik's arms: axes and points (n x 3) of the joints in the world at q = 0, the tool at `home` there."""

    def __init__(self, module):
        self.name = module.__name__.rpartition(".")[2].removesuffix("_ik")
        self.solve = module.solve
        frame, axes, points = np.eye(4), [], []
        for joint in module._KB.joints:
            frame = frame @ joint.T_left
            axes.append(frame[:3, :3] @ joint.axis)
            points.append(frame[:3, 3])
            frame = frame @ joint.T_right
        self.axes, self.points, self.home, self.n = np.array(axes), np.array(points), frame, len(axes)

    def forward(self, q):
        pose = self.home
        for axis, point, value in reversed(list(zip(self.axes, self.points, q, strict=True))):
            x, y, z = axis
            skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
            motion = np.eye(4)
            motion[:3, :3] += np.sin(value) * skew + (1 - np.cos(value)) * skew @ skew
            motion[:3, 3] = point - motion[:3, :3] @ point
            pose = motion @ pose
        return pose

    def aligned(self):
        """1 or -1 for each joint: with its axis times that, no axis is opposite to a parallel one before it, which EAIK and
        IK-Geo expect."""
        signs = np.ones(self.n)
        for i in range(1, self.n):
            for k in range(i):
                if self.parallel(k, i):
                    signs[i] = np.sign(signs[k] * self.axes[k] @ self.axes[i])
                    break
        return signs

    def offsets(self, points):
        return np.diff(np.vstack([np.zeros(3), points, self.home[:3, 3]]), axis=0)

    def parallel(self, *joints):
        return all(np.linalg.norm(np.cross(self.axes[joints[0]], self.axes[k])) < 1e-9 for k in joints[1:])

    def meet(self, *joints):
        axes, points = self.axes[list(joints)], self.points[list(joints)]
        if self.parallel(*joints):
            return False
        point = meeting_point(axes, points)
        return np.linalg.norm(np.cross(axes, points - point), axis=1).max() < 1e-9


def beeline_solver(arm):
    joints = [beeline.Joint(name=f"joint{i + 1}", screw=np.append(np.cross(point, axis), axis))
              for i, (axis, point) in enumerate(zip(arm.axes, arm.points, strict=True))]
    made = beeline.Arm(arm.name, joints, tool=arm.home)
    options = {"all": arm.n <= 6, "ignore_limits": True}
    return (lambda pose: beeline.inverse_kinematics(made, pose, **options), lambda answer: list(answer.solutions),
            beeline.inverse_method(made, **options))


def ssik_solver(arm):
    most = None if arm.n <= 6 else 1
    return (lambda pose: arm.solve(pose, respect_limits=False, max_solutions=most),
            lambda answer: [solution.q for solution in answer], "")


def eaik_solver(arm):
    if arm.n != 6:
        return None
    signs = arm.aligned()
    robot = EAIK.Robot((signs * arm.axes.T), arm.offsets(arm.points).T, arm.home[:3, :3], [], True)
    if not robot.has_known_decomposition():
        return None
    return (robot.calculate_IK,
            lambda answer: [signs * q for q, off in zip(answer.Q, answer.is_LS, strict=True) if not off], "")


def ik_geo_solver(arm):
    """Its user must know the family: joints whose axes meet, or are parallel. Its search for general arms takes seconds a
    pose and is left out."""
    if arm.n != 6:
        return None
    families = [
        (Robot.spherical_two_parallel, arm.meet(3, 4, 5) and arm.parallel(1, 2), [(3, 4, 5)]),
        (Robot.spherical_two_intersecting, arm.meet(3, 4, 5) and arm.meet(0, 1), [(0, 1), (3, 4, 5)]),
        (Robot.spherical, arm.meet(3, 4, 5), [(3, 4, 5)]),
        (Robot.three_parallel_two_intersecting, arm.parallel(1, 2, 3) and arm.meet(4, 5), [(4, 5)]),
        (Robot.three_parallel, arm.parallel(1, 2, 3), []),
    ]
    for family, applies, meetings in families:
        if applies:
            break
    else:
        return None
    points = arm.points.copy()
    for joints in meetings:
        points[list(joints)] = meeting_point(arm.axes[list(joints)], points[list(joints)])
    signs = arm.aligned()
    robot = family((signs[:, None] * arm.axes).tolist(), arm.offsets(points).tolist())

    def ask(pose):  # it takes a rotation as its columns
        return robot.get_ik((pose[:3, :3] @ arm.home[:3, :3].T).T.tolist(), pose[:3, 3].tolist())

    return ask, lambda answer: [signs * q for q, off in answer if not off], ""


def add_distinct(rows, q):
    """Appends the configuration unless it is there already, whole turns aside; returns its place."""
    for i, row in enumerate(rows):
        if np.abs(np.remainder(q - row + np.pi, 2 * np.pi) - np.pi).max() < APART:
            return i
    rows.append(q)
    return len(rows) - 1


def measured(arm, poses):
    """For each solver: solutions found, missed and wrong, poses solved, median microseconds."""
    makers = dict(zip(SOLVERS, [beeline_solver, ssik_solver, eaik_solver, ik_geo_solver], strict=True))
    solvers = {name: made for name, make in makers.items() if (made := make(arm))}
    times, found, wrong, missing = defaultdict(list), defaultdict(list), dict.fromkeys(solvers, 0), []
    for pose in poses:
        known, places = [], {}
        for name, (ask, read, _) in solvers.items():
            start = time.perf_counter_ns()
            answer = ask(pose)
            times[name].append((time.perf_counter_ns() - start) / 1000)
            places[name] = set()
            for q in read(answer):
                error = np.abs(arm.forward(q) - pose).max()
                wrong[name] += bool(error > TOLERANCE)
                if error <= TOLERANCE:
                    places[name].add(add_distinct(known, q))
        for name in solvers:
            found[name].append(len(places[name]))
        if len(places["Beeline"]) < len(known) and arm.n <= 6:
            missing.append((pose, [q for i, q in enumerate(known) if i not in places["Beeline"]]))
        found["all"].append(len(known))
    rows = {name: {"solutions": sum(found[name]), "missed": sum(found["all"]) - sum(found[name]), "wrong": wrong[name],
                   "solved": sum(map(bool, found[name])), "median": statistics.median(times[name]), "mean": statistics.fmean(times[name])} for name in solvers}
    return solvers["Beeline"][2], rows, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--poses", type=int, default=100)
    parser.add_argument("--arms", nargs="*")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    names = [name for _, name, package in pkgutil.walk_packages(ssik.prebuilt.__path__, "ssik.prebuilt.") if not package]
    ratios, sums = defaultdict(lambda: defaultdict(list)), defaultdict(lambda: defaultdict(int))
    print(f"seed {options.seed}, {options.poses} poses an arm, microseconds a call from Python, solvers taking turns\n")
    print("| arm | Beeline's method | "
          + " | ".join(f"{s}: solutions, missed, wrong | median, mean µs" for s in SOLVERS) + " |")
    print("|---|---|" + "---|---|" * len(SOLVERS))
    for name in names:
        module = importlib.import_module(name)
        if not hasattr(module, "_KB"):
            continue
        arm = MarketArm(module)
        if options.arms and arm.name not in options.arms:
            continue
        random = np.random.default_rng(options.seed)
        poses = [arm.forward(q) for q in random.uniform(-np.pi, np.pi, (options.poses, arm.n))]
        method, rows, missing = measured(arm, poses)
        cells = []
        for solver in SOLVERS:
            row = rows.get(solver)
            if row is None:
                cells.append("– | –")
                continue
            count = f"{row['solutions']}, {row['missed']}, {row['wrong']}" if arm.n <= 6 else f"{row['solved']} poses"
            cells.append(f"{count} | {row['median']:.1f}, {row['mean']:.1f}")
            family = method.partition(" (")[0] if arm.n <= 6 else f"{arm.n} joints"
            for key in ("solutions", "missed", "wrong", "solved"):
                sums[family, solver][key] += row[key]
            for key in ("median", "mean"):
                ratios[family, solver][key].append(rows["Beeline"][key] / row[key])
            sums[family, solver]["arms"] += 1
        print(f"| {arm.name} | {method} | " + " | ".join(cells) + " |", flush=True)
        for pose, lost in missing:
            print(f"  Beeline misses {len(lost)}: {arm.name} pose {pose[:3].tolist()} q {lost[0].tolist()}")
    print("\n| family | solver | arms | poses solved | solutions | missed | wrong | Beeline / solver: medians | means |")
    print("|---|---|---|---|---|---|---|---|---|")
    for (family, solver), sum_of in sums.items():
        seven = family == "7 joints"
        counts = ["–", "–"] if seven else [sum_of["solutions"], sum_of["missed"]]
        print(f"| {family} | {solver} | {sum_of['arms']} | {sum_of['solved']} | {counts[0]} | {counts[1]} |"
              f" {sum_of['wrong']} | {statistics.median(ratios[family, solver]['median']):.2f}"
              f" | {statistics.median(ratios[family, solver]['mean']):.2f} |")


if __name__ == "__main__":
    main()
