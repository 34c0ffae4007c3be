"""Microseconds a call from Python: Beeline, its C++ time, and other packages, interleaved in one run, every second round
in reverse order.

Usage: calls.py FOLDER, the folder of libbench_calls.so. Prints tables in Markdown. CPU time of the thread, the
median of rounds, so that a busy machine can be used."""

import ctypes
import statistics
import sys
import time
import warnings
from pathlib import Path

import beeline
import numpy as np
from peers import PEERS, arm_of, urdf_of

ROUNDS, ROWS, BATCH, SEED = 9, 300, 1_000_000, 20240229
BEELINE = {
    "forward": "forward(arm, q)",
    "forward_list": "forward(arm, q)",
    "forward_name": "forward(name, q)",
    "jacobian": "jacobian(arm, q)",
    "inverse": "inverse(arm, T).q",
    "inverse_into": "inverse(arm, T, seed=middle, out=out)",
    "all": "inverse(arm, T, all=True, ignore_limits=True).solutions",
    "no": "bool(inverse(arm, T))",
}
TITLES = {
    "forward": "forward kinematics",
    "forward_list": "forward kinematics, q a list",
    "forward_name": "forward kinematics, the arm's name",
    "jacobian": "Jacobian",
    "inverse": "`inverse_kinematics`",
    "inverse_into": "`inverse_kinematics`, `out=`",
    "all": "`inverse_kinematics`, `all`, limits ignored",
    "no": "`inverse_kinematics` of a pose without a solution",
    "first": "`inverse_kinematics`, first of a new arm",
}
CPP = {"forward_list": "forward", "forward_name": "forward", "no": "inverse"}  # the same call in C++
ARMS = ("ur5", "panda", "crx10ia", "gen3", "rizon4")


class Case:
    """One expression in q, T and G (what `prepare` makes of T), timed over all rows."""

    def __init__(self, expression, names, q, poses, prepare=None):
        scope = dict(names)
        self.rows = list(zip(q, poses, [eval(prepare, scope, {"T": T}) for T in poses] if prepare else poses))
        exec(f"def run(rows):\n for q, T, G in rows:\n  {expression}", scope)
        exec(f"def one(q, T, G): return {expression}", scope)
        self.run, self.one, self.times = scope["run"], scope["one"], []
        self.run(self.rows[:3])
        begin = time.thread_time()
        self.run(self.rows[:3])
        seconds = time.thread_time() - begin
        if seconds > 0.01:
            self.rows = self.rows[: 20 if seconds < 0.05 else 5]

    def measure(self):
        begin = time.thread_time()
        self.run(self.rows)
        self.times.append((time.thread_time() - begin) / len(self.rows) * 1e6)

    def microseconds(self):
        return statistics.median(self.times)


class FirstCalls:
    """The first call of each of many arms, which computes what follows from the arm."""

    def __init__(self, arm, poses):
        self.arm, self.poses, self.times = arm, poses[:20], []

    def measure(self):
        text = self.arm.to_json()
        arms = [beeline.Arm.from_json(text) for _ in self.poses]
        begin = time.thread_time()
        for arm, pose in zip(arms, self.poses):
            beeline.inverse_kinematics(arm, pose)
        self.times.append((time.thread_time() - begin) / len(arms) * 1e6)

    def microseconds(self):
        return statistics.median(self.times)


class CppCase:
    def __init__(self, library, arm, what, q, poses):
        columns = np.ascontiguousarray(poses.swapaxes(1, 2))
        pointer = ctypes.POINTER(ctypes.c_double)
        self.arguments = (arm.to_json().encode(), what.encode(), q.ctypes.data_as(pointer),
                          columns.ctypes.data_as(pointer), ctypes.c_long(len(q)))
        self.kept, self.function, self.times = (q, columns), library.time_calls, []

    def measure(self):
        self.times.append(self.function(*self.arguments) / len(self.kept[0]) * 1e6)

    def microseconds(self):
        return statistics.median(self.times)


def solved(case, forward, poses):
    """Share of the poses that a solution reaches, to 1e-5."""
    right = 0
    for row in case.rows:
        try:
            found = np.atleast_2d(np.asarray(case.one(*row), float))
            right += any(np.abs(forward(q) - row[1]).max() < 1e-5 for q in found)
        except Exception:  # no solution
            pass
    return right / len(case.rows)


def without_solution(arm, random):
    """Poses within the arm's sphere, of any orientation, that no configuration reaches."""
    found = []
    while len(found) < ROWS:
        pose = random_pose(arm, random)
        if not beeline.inverse_kinematics(arm, pose):
            found.append(pose)
    return np.array(found)


def random_pose(arm, random):
    pose = np.eye(4)
    turn, _ = np.linalg.qr(random.normal(size=(3, 3)))
    pose[:3, :3] = turn * np.sign(np.linalg.det(turn))
    away = random.normal(size=3)
    centre, radius = arm.reach
    pose[:3, 3] = centre + radius * random.uniform() ** (1 / 3) * away / np.linalg.norm(away)
    return pose


def own_frame(peer):
    """Whether the peer computes with the arm of the URDF text, not with one that it brings along."""
    return peer not in ("ssik", "frankik")


def cases_of(library, arm, q, left_out):
    poses = np.ascontiguousarray(beeline.forward_kinematics(arm, q))
    unreached = without_solution(arm, np.random.default_rng(SEED))
    own = {"arm": arm, "name": arm.name, "forward": beeline.forward_kinematics, "jacobian": beeline.jacobian, "middle": arm.middle,
           "inverse": beeline.inverse_kinematics, "out": np.empty(arm.dof)}
    def goals(what):
        return unreached if what == "no" else poses

    built_in = arm.name in {each.name for each in beeline.built_in_arms()}
    asked = [what for what in BEELINE if what != "forward_name" or built_in]
    cases = {(what, "Beeline"): Case(BEELINE[what], own, q.tolist() if what == "forward_list" else q, goals(what))
             for what in asked}
    for what in asked:
        rows = len(cases[what, "Beeline"].rows)
        cases[what, "C++"] = CppCase(library, arm, CPP.get(what, what), q[:rows], goals(what)[:rows])
    cases |= {("first", "Beeline"): FirstCalls(arm, poses), ("first", "C++"): CppCase(library, arm, "first", q[:20], poses[:20])}
    urdf, shares = urdf_of(arm), {}
    for name, peer in PEERS.items():
        try:
            names, calls = peer(arm, urdf)
            prepare = calls.pop("prepare", None)
            forward = eval("lambda q: " + calls["forward"], dict(names)) if "forward" in calls else arm.forward_kinematics
            own_poses = np.array([forward(row) for row in q])
            for what, call in calls.items():
                cases[what, name] = Case(call, names, q, own_poses, prepare)
            if "inverse" in calls and own_frame(name):
                cases["no", name] = Case(calls["inverse"], names, q, unreached, prepare)
            if "inverse" in calls:
                shares[name] = solved(cases["inverse", name], forward, own_poses)
        except Exception as error:  # a peer that is not installed, or has no such arm
            left_out.append(f"{name} for {arm.name}: {error}")
    return cases, shares


def print_calls(library):
    print("| arm | call |", " | ".join(["C++", "Beeline", "difference", "Beeline / best peer", *PEERS]), "|")
    print("|---" * (6 + len(PEERS)) + "|")
    left_out = []
    for name in ARMS:
        arm = arm_of(name)
        lower, upper = arm.lower.clip(-3.1, 3.1), arm.upper.clip(-3.1, 3.1)
        q = np.random.default_rng(SEED).uniform(lower, upper, (ROWS, arm.dof))
        cases, shares = cases_of(library, arm, q, left_out)
        for i in range(ROUNDS):
            for case in list(cases.values())[:: 1 if i % 2 else -1]:
                case.measure()
        for what, title in TITLES.items():
            if (what, "Beeline") not in cases:
                continue
            own, cpp = (cases[what, who].microseconds() for who in ("Beeline", "C++"))
            others = [cases[what, peer].microseconds() for peer in PEERS if (what, peer) in cases]
            row = [f"{cpp:.3f}", f"{own:.3f}", f"{own - cpp:.3f}", f"{own / min(others):.3f}" if others else ""]
            for peer in PEERS:
                case = cases.get((what, peer))
                share = f" ({100 * shares[peer]:.0f} %)" if case and what == "inverse" else ""
                row.append(f"{case.microseconds():.3g}{share}" if case else "")
            print(f"| {name} | {title} |", " | ".join(row), "|")
    for line in left_out:
        print(f"\nLeft out: {line}")


def batch_times(library, function, name, arm, q, threads):
    fresh = function(arm, q)
    memory = fresh.swapaxes(1, 2)
    pointer = ctypes.POINTER(ctypes.c_double)
    clock = time.thread_time if threads == 1 else time.perf_counter
    cpp, cpp_new, into, new = [], [], [], []
    for _ in range(ROUNDS):
        for times, results in ((cpp, memory.ctypes.data_as(pointer)), (cpp_new, None)):
            times.append(library.time_batch(arm.to_json().encode(), name.encode(), q.ctypes.data_as(pointer),
                                            results, ctypes.c_long(len(q)), threads))
        begin = clock()
        function(arm, q, out=fresh, threads=threads)
        into.append(clock() - begin)
        begin = clock()
        function(arm, q, threads=threads)
        new.append(clock() - begin)
    return [statistics.median(times) / len(q) * 1e9 for times in (cpp, into, cpp_new, new)]


def print_batches(library):
    print(f"\nBatches of {BATCH:,} configurations of panda, ns a configuration:\n")
    print("| batch | threads | C++ | Python, `out=` | ratio | C++, new memory | Python, a new array | ratio |")
    print("|---" * 8 + "|")
    arm = beeline.arms.panda()
    q = np.random.default_rng(SEED).uniform(arm.lower, arm.upper, (BATCH, arm.dof))
    for name, function in (("forward", beeline.forward_kinematics), ("jacobian", beeline.jacobian)):
        for threads in (1, 0):
            cpp, into, cpp_new, new = batch_times(library, function, name, arm, q, threads)
            label = "one (CPU time)" if threads == 1 else "all (wall time)"
            print(f"| {name} | {label} | {cpp:.1f} | {into:.1f} | {into / cpp:.3f} | {cpp_new:.1f} | {new:.1f} |"
                  f" {new / cpp_new:.3f} |")


def main():
    warnings.simplefilter("ignore")  # of ikpy, about its start
    library = ctypes.CDLL(str(Path(sys.argv[1]).resolve() / "libbench_calls.so"))
    library.time_calls.restype = library.time_batch.restype = ctypes.c_double
    print_calls(library)
    print_batches(library)


if __name__ == "__main__":
    main()
