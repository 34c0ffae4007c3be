"""OMPL's RRT-Connect with its shortening on the problems that bench_free_paths wrote: Markdown tables.

Usage: ompl_paths.py PATHS.jsonl ARM.urdf [--resolution 0.05] [--clearance 0.001] [--problems 1000]

OMPL samples its motions: the configurations at every --resolution rad are tested by Beeline's model, called from Python, so
the time inside the tests is stated apart. The table has the time outside of them too: OMPL's own, and the calls. Each motion of the
shortened paths is then examined by beeline.prove_clearance(), which finds what the samples have missed. Times are of the wall
clock, one thread, milliseconds; Beeline's are bench_free_paths's: the proof of every motion is in them."""

import argparse
import json
import os
import statistics
import tempfile
import time

import beeline
from ompl import base, geometric, util

SECONDS = 20.0  # for a problem


def read_shaped_arm(path, folder):
    """The arm and the shapes of its links, with its fingers at 0.065 m as in the problems."""
    with open(path) as file:
        urdf = file.read()
    has_fingers = 'name="panda_finger_joint1" type="prismatic"' in urdf
    wide = os.path.join(folder, "arm.urdf")
    with open(wide, "w") as file:
        file.write(urdf.replace('upper="0.04"', 'upper="0.07"'))
    tip = "panda_link8" if '<link name="panda_link8"' in urdf else None
    package = {"example-robot-data": os.path.realpath(path).partition("/robots/")[0]}
    hold = {"panda_finger_joint1": 0.065} if has_fingers else {}
    return beeline.Arm.load(wide, tip=tip), beeline.read_arm_shapes(wide, tip=tip, hold=hold, package=package)


def model_of(arm, shapes, scene, clearance, folder):
    path = os.path.join(folder, "scene.json")
    with open(path, "w") as file:
        json.dump(scene, file)
    return beeline.CollisionModel(arm, shapes.links, beeline.read_scene(path), clearance=clearance)


class Checker:
    """Whether a state is free, with the number of calls and their time, seconds."""

    def __init__(self, model):
        self.model, self.count, self.seconds = model, 0, 0.0

    def __call__(self, state):
        begin = time.perf_counter()
        free = not beeline.blocked_by(self.model, [state[k] for k in range(self.model.arm.dof)])
        self.seconds += time.perf_counter() - begin
        self.count += 1
        return free


def space_of(arm):
    space, bounds = base.RealVectorStateSpace(arm.dof), base.RealVectorBounds(arm.dof)
    for k in range(arm.dof):
        bounds.setLow(k, arm.lower[k])
        bounds.setHigh(k, arm.upper[k])
    space.setBounds(bounds)
    return space


def state_of(information, q):
    state = information.allocState()
    for k, value in enumerate(q):
        state[k] = value
    return state


def refuted(model, path, count):
    """Whether a motion between two states of the path is proved to come closer than the clearance."""
    arm = model.arm
    states = [[path.getState(i)[k] for k in range(arm.dof)] for i in range(count)]
    for pair in zip(states, states[1:]):
        if beeline.prove_clearance(model, beeline.Trajectory(arm.joint_names, [0, 1], list(pair))).status == "collides":
            return True
    return False


def solve(model, line, resolution):
    """What OMPL needs for a problem; None if it finds no path."""
    space = space_of(model.arm)
    setup = geometric.SimpleSetup(space)
    information = setup.getSpaceInformation()
    information.setStateValidityCheckingResolution(resolution / space.getMaximumExtent())
    checker = Checker(model)
    setup.setStateValidityChecker(checker)
    setup.setStartAndGoalStates(state_of(information, line["start"]), state_of(information, line["goal"]), 1e-9)
    setup.setPlanner(geometric.RRTConnect(information))
    setup.solve(SECONDS)
    if not setup.haveExactSolutionPath():
        return None
    planning = setup.getLastPlanComputationTime()
    checks, inside = checker.count, checker.seconds
    setup.simplifySolution()
    path = setup.getSolutionPath()
    shortening = setup.getLastSimplificationTime()
    return {
        "planning": 1e3 * planning,
        "planning, outside the tests": 1e3 * (planning - inside),
        "shortening": 1e3 * shortening,
        "shortening, outside the tests": 1e3 * (shortening - checker.seconds + inside),
        "tests, planning": checks,
        "tests, in all": checker.count,
        "time of a test, µs": 1e6 * checker.seconds / checker.count,
        "length": path.length(),
        "refuted": refuted(model, path, path.getStateCount()),
    }


def row(name, values):
    ordered = sorted(values)
    print(f"| {name} | {statistics.median(ordered):.4g} | {ordered[len(ordered) * 95 // 100]:.4g} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paths")
    parser.add_argument("arm")
    parser.add_argument("--resolution", type=float, default=0.05)
    parser.add_argument("--clearance", type=float, default=1e-3)
    parser.add_argument("--problems", type=int, default=1000)
    options = parser.parse_args()
    util.setLogLevel(util.LogLevel.LOG_ERROR)
    util.RNG.setSeed(1)
    found, ours, ratios, unsolved, first = [], [], [], [], []
    with tempfile.TemporaryDirectory() as folder, open(options.paths) as file:
        arm, shapes = read_shaped_arm(options.arm, folder)
        for line in list(map(json.loads, file))[: options.problems]:
            model = model_of(arm, shapes, line["scene"], options.clearance, folder)
            if beeline.blocked_by(model, line["start"]) or beeline.blocked_by(model, line["goal"]):
                first.append(line["name"])
                continue
            answer = solve(model, line, options.resolution)
            if answer is None:
                unsolved.append(line["name"])
                continue
            found.append(answer)
            if line["solved"]:
                ours.append(line["milliseconds"])
                ratios.append(line["length"] / answer["length"])
    print(f"OMPL solves {len(found)} of {len(found) + len(unsolved)} problems" + "".join(f", not {name}" for name in unsolved))
    print(f"Left out, blocked at the start or the goal: {', '.join(first) or 'none'}")
    print(f"Shortened paths that are proved to come closer than the clearance: {sum(one['refuted'] for one in found)}\n")
    print("| | median | 95 % |\n|---|---|---|")
    for name in found[0]:
        if name != "refuted":
            row(name, [one[name] for one in found])
    row("Beeline, proved", ours)
    row("Beeline's length over OMPL's", ratios)


if __name__ == "__main__":
    main()
