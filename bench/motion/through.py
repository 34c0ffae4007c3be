"""Joint motions through many waypoints: Beeline beside toppra and ruckig.

Usage: through.py [--waypoints 10 100 1000] [--paths N] [--seed S]

Seven joints with the limits of a Panda, waypoints at random in the middle of their ranges. Prints a table in
Markdown. `velocity`, `acceleration` and `jerk` are the largest fractions of a limit that a motion uses, by
this script's own evaluation of it between its samples. Milliseconds are CPU time, the least of three runs.

toppra takes minimum time under limits of velocity and acceleration along the spline that Beeline takes too:
both get no limit of jerk there. ruckig's community version passes no waypoints without a stop (those need
its cloud service), so it moves from rest to rest between neighbours. Beeline does that too, with
joint_blend=0, moves along straight lines with blends, and along the spline. A program passes the waypoints in
blends whose distance from them is one of the tool; its time includes the proof of the motion.
"""

import argparse
import logging
import time

import beeline
import numpy

logging.disable(logging.WARNING)
try:
    import toppra
    from toppra.algorithm import TOPPRA
    from toppra.constraint import JointAccelerationConstraint, JointVelocityConstraint
except ImportError:
    toppra = None
try:
    import ruckig
except ImportError:
    ruckig = None

PANDA = beeline.arms.panda()
VELOCITY, ACCELERATION, JERK = (
    numpy.array([getattr(joint.limits, name) for joint in PANDA.joints]) for name in ("velocity", "acceleration", "jerk"))
NO_JERK = PANDA.with_limits({joint.name: beeline.LimitOverrides(jerk=numpy.inf) for joint in PANDA.joints})
TIMES = 20  # of an interval between samples


def fractions(velocity, acceleration, jerk):
    """The largest fractions of the limits; jerk may be unknown."""
    return [numpy.max(numpy.abs(rates) / limit) if rates is not None else numpy.inf
            for rates, limit in ((velocity, VELOCITY), (acceleration, ACCELERATION), (jerk, JERK))]


def evaluated(trajectory):
    """The quintic polynomials between the samples, at some times of each interval and on both of its sides."""
    t, q, v, a = (numpy.asarray(column) for column in (
        trajectory.times, trajectory.positions, trajectory.velocities, trajectory.accelerations))
    h = numpy.diff(t)[:, None]
    d = numpy.diff(q, axis=0)
    v0, v1, a0, a1 = h * v[:-1], h * v[1:], h**2 * a[:-1], h**2 * a[1:]
    c3 = 10 * d - 6 * v0 - 4 * v1 - 1.5 * a0 + 0.5 * a1
    c4 = -15 * d + 8 * v0 + 7 * v1 + 1.5 * a0 - a1
    c5 = 6 * d - 3 * (v0 + v1) - 0.5 * (a0 - a1)
    worst = numpy.zeros(3)
    for u in numpy.linspace(0, 1, TIMES + 1):
        worst = numpy.maximum(worst, fractions(
            (v0 + u * a0 + u**2 * (3 * c3 + u * (4 * c4 + u * 5 * c5))) / h,
            (a0 + u * (6 * c3 + u * (12 * c4 + u * 20 * c5))) / h**2,
            (6 * c3 + u * (24 * c4 + u * 60 * c5)) / h**3))
    return worst


def shortest_time(compute, runs=3):
    best = numpy.inf
    for _ in range(runs):
        begin = time.process_time()
        result = compute()
        best = min(best, time.process_time() - begin)
    return result, 1e3 * best


def of_beeline(arm, runs, **options):
    def measured(waypoints):
        motion, milliseconds = shortest_time(lambda: beeline.move_through(arm, waypoints, **options), runs)
        if not motion:
            raise RuntimeError(str(motion.reason))
        return motion.duration, milliseconds, evaluated(motion.trajectory)
    return measured


def of_program(arm, runs, blend):
    """A program of joint moves, whose blends are metres of the tool; its plan contains the proof."""
    def measured(waypoints):
        moves = [beeline.Move("joint", q=q, blend=blend) for q in waypoints[1:-1]]
        moves.append(beeline.Move("joint", q=waypoints[-1]))
        motion, milliseconds = shortest_time(
            lambda: beeline.move_program(arm, waypoints[0], beeline.Program(moves)), runs)
        if not motion:
            raise RuntimeError(str(motion.reason))
        return motion.duration, milliseconds, evaluated(motion.trajectory)
    return measured


def of_toppra(waypoints):
    chords = numpy.linalg.norm(numpy.diff(waypoints, axis=0), axis=1)
    spline = toppra.SplineInterpolator(numpy.concatenate([[0], numpy.cumsum(chords)]), waypoints)

    def compute():
        solver = TOPPRA([JointVelocityConstraint(VELOCITY), JointAccelerationConstraint(ACCELERATION)], spline,
                        solver_wrapper="seidel")
        return solver.gridpoints, solver.compute_parameterization(0, 0)[1]

    (s, speed), milliseconds = shortest_time(compute)
    if speed is None:
        return None
    duration = numpy.sum(2 * numpy.diff(s) / (speed[1:] + speed[:-1]))
    b = speed**2
    push = numpy.diff(b) / (2 * numpy.diff(s))
    worst = numpy.zeros(3)
    for u in numpy.linspace(0, 1, TIMES + 1):
        at, square = s[:-1] + u * numpy.diff(s), (b[:-1] + u * numpy.diff(b))[:, None]
        worst = numpy.maximum(worst, fractions(
            spline(at, 1) * numpy.sqrt(square), spline(at, 1) * push[:, None] + spline(at, 2) * square, None))
    return duration, milliseconds, worst


def of_ruckig(waypoints):
    generator = ruckig.Ruckig(7)
    given, trajectory = ruckig.InputParameter(7), ruckig.Trajectory(7)
    given.max_velocity, given.max_acceleration, given.max_jerk = list(VELOCITY), list(ACCELERATION), list(JERK)

    def compute():
        durations = []
        for a, b in zip(waypoints, waypoints[1:]):
            given.current_position, given.target_position = list(a), list(b)
            generator.calculate(given, trajectory)
            durations.append(trajectory.duration)
        return sum(durations)

    duration, milliseconds = shortest_time(compute)
    worst = numpy.zeros(3)
    for a, b in zip(waypoints, waypoints[1:]):
        given.current_position, given.target_position = list(a), list(b)
        generator.calculate(given, trajectory)
        times = numpy.linspace(0, trajectory.duration, 200)
        states = numpy.array([trajectory.at_time(t)[1:3] for t in times])
        jerk = numpy.diff(states[:, 1], axis=0) / numpy.diff(times)[:, None]
        worst = numpy.maximum(worst, fractions(states[:, 0], states[:, 1], jerk))
    return duration, milliseconds, worst


def methods(count):
    runs = 3 if count <= 100 else 1
    if toppra:
        yield "spline, no limit of jerk", "toppra", of_toppra
    yield "spline, no limit of jerk", "Beeline, `fastest`", of_beeline(NO_JERK, runs, profile="fastest")
    yield "spline", "Beeline", of_beeline(PANDA, runs)
    for blend in (0.2, 0.1):
        yield f"lines, blends up to {blend}", "Beeline", of_beeline(PANDA, runs, joint_blend=blend)
    yield "lines, stops", "Beeline", of_beeline(PANDA, runs, joint_blend=0)
    for blend in (0.05, 0.02):
        yield f"lines, blends within {blend} m", "Beeline, program", of_program(PANDA, runs, blend)
    yield "lines, stops", "Beeline, program", of_program(PANDA, runs, 0)
    if ruckig:
        yield "any way, stops", "ruckig", of_ruckig


def shown(fraction):
    return "" if numpy.isinf(fraction) else f"{fraction:.4f}"


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--waypoints", type=int, nargs="+", default=[10, 100, 1000])
    options.add_argument("--paths", type=int, default=3)
    options.add_argument("--seed", type=int, default=1)
    options = options.parse_args()
    for name, module in (("toppra", toppra), ("ruckig", ruckig)):
        if module is None:
            print(f"Left out: {name} is not installed\n")
    random = numpy.random.default_rng(options.seed)
    middle, span = PANDA.middle, numpy.asarray(PANDA.upper) - numpy.asarray(PANDA.lower)
    print(f"Seed {options.seed}, medians over {options.paths} paths; the largest fractions of all of them\n")
    print("| waypoints | path | by | seconds | ms | velocity | acceleration | jerk |")
    print("|---|---|---|---|---|---|---|---|")
    for count in options.waypoints:
        paths = [middle + 0.3 * span * random.uniform(-1, 1, (count, 7)) for _ in range(options.paths)]
        for path, by, measure in methods(count):
            found = [result for result in map(measure, paths) if result]
            if not found:
                print(f"| {count:,} | {path} | {by} | none | | | | |", flush=True)
                continue
            durations, milliseconds, worst = zip(*found)
            cells = " | ".join(shown(fraction) for fraction in numpy.max(worst, axis=0))
            print(f"| {count:,} | {path} | {by} | {numpy.median(durations):.2f} | {numpy.median(milliseconds):.2f} "
                  f"| {cells} |", flush=True)


if __name__ == "__main__":
    main()
