"""Motions from point to point, time scalings and retiming: limits, laws, endings, refusals."""

import ast
import copy
import pickle
import re

import beeline
import numpy as np
import pytest

PANDA = beeline.arms.panda()
PROFILES = ast.literal_eval(re.search(r"\nprofile : typing\.Literal(\[.*?\])", beeline.retime.__doc__)[1])


def waypoints(rng, count=5, size=0.4):
    q = PANDA.middle + rng.uniform(-size, size, (count, 7))
    return beeline.Trajectory(PANDA.joint_names, range(count), q)


def assert_within_limits(trajectory, slack=1e-6):
    """By sampling, which shares nothing with limit_usage() but sample()."""
    state = trajectory.sample(np.linspace(trajectory.times[0], trajectory.times[-1], 20001))
    for values, limits in ((state.velocity, PANDA.velocity), (state.acceleration, PANDA.acceleration),
                           (state.jerk, PANDA.jerk)):
        assert (np.abs(values) / limits).max() < 1 + slack


def test_an_s_curve_is_its_own_integral(rng):
    limits = beeline.Limits(velocity=1.2, acceleration=3, jerk=20)
    curve = beeline.s_curve(rng.uniform(0.5, 2), limits)
    assert curve.duration == pytest.approx(4 * curve.jerk_time + 2 * curve.acceleration_time + curve.cruise_time)
    t = np.linspace(0, curve.duration, 2001)
    states = [curve.at(x) for x in t]
    assert max(abs(s.velocity) for s in states) <= 1.2 * (1 + 1e-12)
    assert max(abs(s.acceleration) for s in states) <= 3 * (1 + 1e-12)
    velocity = np.array([s.velocity for s in states])
    integral = np.concatenate([[0], np.cumsum((velocity[1:] + velocity[:-1]) / 2 * np.diff(t))])
    assert np.abs(integral - [s.position for s in states]).max() < 1e-5
    longer = curve.stretched(2 * curve.duration)
    assert longer.at(longer.duration).position == curve.distance and longer.duration == 2 * curve.duration


@pytest.mark.parametrize("synchronise", ["time", "straight"])
def test_motions_from_rest_to_rest(synchronise, rng):
    start, goal = PANDA.middle + rng.uniform(-0.4, 0.4, (2, 7))
    motion = beeline.point_to_point(PANDA, start, goal, synchronise=synchronise)
    assert np.array_equal(motion.from_, start) and np.array_equal(motion.to, goal)
    at = motion.sample(np.linspace(-1, motion.duration + 1, 3001))
    assert np.array_equal(at.position[0], start) and np.array_equal(at.position[-1], goal)
    for values, limits in ((at.velocity, PANDA.velocity), (at.acceleration, PANDA.acceleration), (at.jerk, PANDA.jerk)):
        assert (np.abs(values) / limits).max() < 1 + 1e-9
    travelled = (at.position - start) / (goal - start)
    if synchronise == "straight":
        assert np.ptp(travelled, axis=1).max() < 1e-9
    else:
        assert motion.duration <= beeline.point_to_point(PANDA, start, goal, synchronise="straight").duration + 1e-12
    sampled = beeline.sampled(PANDA, motion, 500)
    assert np.array_equal(sampled.positions[[0, -1]], [start, goal])
    assert np.abs(np.diff(sampled.times) - 0.002).max() < 2e-9
    assert_within_limits(sampled)


def test_limits_without_an_arm(rng):
    limits = [beeline.Limits(velocity=v, acceleration=a, jerk=j) for v, a, j in rng.uniform(0.5, 5, (4, 3))]
    distance = rng.uniform(-2, 2, 4)
    motion = beeline.point_to_point(limits, np.zeros(4), distance)
    alone = [beeline.s_curve(d, l).duration for d, l in zip(distance, limits)]
    assert motion.duration == max(alone)
    assert [curve.duration for curve in motion.curves] == [motion.duration] * 4


@pytest.mark.parametrize("profile", PROFILES)
def test_retimed_within_limits_on_the_same_path(profile, rng):
    given = waypoints(rng)
    retimed = beeline.retime(PANDA, given, profile=profile)
    assert retimed and retimed.profile == profile and retimed.ending == "complete"
    trajectory = retimed.trajectory
    assert trajectory.interpolation == "quintic" and trajectory is retimed.trajectory
    for q in given.positions:
        assert np.abs(trajectory.positions - q).max(1).min() < 1e-9
    state = trajectory.sample([trajectory.times[0], trajectory.times[-1]])
    assert not state.velocity.any()
    usage = retimed.limits
    assert max(usage.velocity.fraction, usage.acceleration.fraction) <= 1 + 1e-9
    assert_within_limits(trajectory)
    scaled = beeline.retime(PANDA, given, profile=profile, speed_scale=0.5).trajectory
    assert scaled.duration == pytest.approx(2 * trajectory.duration, rel=0.02)


@pytest.mark.parametrize("profile", PROFILES)
def test_time_scalings_keep_limits(profile, rng):
    given = waypoints(rng).positions
    path = beeline.refined(beeline.joint_spline(given, beeline.chord_length(given)), min_steps=200)
    limits = beeline.path_limits(PANDA)
    scaling = beeline.time_scaling(path, limits, profile)
    assert scaling and scaling.duration == scaling.t[-1]
    assert scaling.speed[0] == scaling.speed[-1] == 0
    velocity = path.dq * np.interp(path.s, scaling.s, scaling.speed)[:, None]
    assert (np.abs(velocity) / limits.velocity).max() < 1 + 1e-3
    slower = beeline.path_limits(PANDA, 0.5)
    assert np.allclose(slower.acceleration, limits.acceleration / 4) and np.allclose(slower.jerk, limits.jerk / 8)
    bounded = beeline.PathLimits(limits.velocity, limits.acceleration, limits.jerk, speed=np.full(len(path), 0.3))
    assert beeline.time_scaling(path, bounded, profile).speed.max() <= 0.3 + 1e-9


def test_a_budget_ends_the_search_with_a_result(rng):
    given = waypoints(rng, count=40)
    ended = beeline.retime(PANDA, given, max_work=1)
    assert ended.ending == "work_limit"
    again = beeline.retime(PANDA, given, max_work=1)
    assert again == ended  # the same on every machine
    assert beeline.retime(PANDA, given, time_limit=0).ending == "time_limit"
    assert beeline.limit_usage(PANDA, given, max_work=1).ending == "work_limit"


def test_a_negative_answer_has_a_reason(rng):
    answer = beeline.retime(PANDA, waypoints(rng), rate=1e6, max_samples=10)
    assert not answer and "samples per second" in answer.reason and len(answer.trajectory) == 0
    outside = beeline.Trajectory(PANDA.joint_names, [0, 1], [PANDA.middle, PANDA.middle + 9])
    answer = beeline.retime(PANDA, outside)
    assert not answer and "joint1" in answer.reason


def test_unknown_limits_are_assumed():
    assumed = beeline.motion_limits(beeline.Limits())
    assert (assumed.velocity, assumed.acceleration, assumed.jerk) == (1, 4, 40)
    known = beeline.Limits(velocity=2, acceleration=3, jerk=4)
    assert beeline.motion_limits(known) == known


def test_copies_and_pickles_are_equal(rng):
    given = waypoints(rng)
    path = beeline.joint_spline(given.positions, beeline.chord_length(given.positions))
    limits = beeline.path_limits(PANDA)
    motion = beeline.point_to_point(PANDA, *given.positions[:2])
    retimed = beeline.retime(PANDA, given)
    for value in (motion, motion.curves[0], motion.curves[0].at(0.1), limits, beeline.time_scaling(path, limits), retimed,
                  retimed.limits, retimed.limits.velocity, motion.sample([0, 0.1])):
        for other in (copy.copy(value), copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
            assert other == value and repr(other) == repr(value)
        assert value != 0 and value != None  # noqa: E711


Q = PANDA.middle
MOTION = beeline.point_to_point(PANDA, Q, Q + 0.1)
TWO = beeline.Trajectory(PANDA.joint_names, [0, 1], [Q, Q + 0.1])
PATH = beeline.joint_spline([Q, Q + 0.1], [0, 1])
REFUSED = {
    "outside its limits": lambda: beeline.point_to_point(PANDA, Q, Q + 10),
    "takes 7 joint values": lambda: beeline.point_to_point(PANDA, Q, Q[:6]),
    "it must be a finite number": lambda: beeline.point_to_point(PANDA, Q, Q * np.nan),
    "NaN": lambda: MOTION.sample([0, np.nan]),
    "rate": lambda: beeline.sampled(PANDA, MOTION, 0),
    "too many samples": lambda: beeline.sampled(PANDA, MOTION, 1e12),
    "two different positions": lambda: beeline.retime(PANDA, beeline.at_rest(PANDA, Q)),
    "does not fit": lambda: beeline.retime(beeline.arms.ur5(), TWO),
    "speed": lambda: beeline.retime(PANDA, TWO, speed_scale=2),
    "unknown profile": lambda: beeline.retime(PANDA, TWO, profile="s_curv"),
    "max_work": lambda: beeline.retime(PANDA, TWO, max_work=-1),
    "time_limit": lambda: beeline.retime(PANDA, TWO, time_limit=-1),
    "as many limits": lambda: beeline.time_scaling(PATH, beeline.PathLimits([1], [1], [1])),
    "cannot be stretched": lambda: MOTION.curves[0].stretched(0.1),
    "must be finite": lambda: beeline.s_curve(np.inf, beeline.Limits(velocity=1)),
}


@pytest.mark.parametrize("message", REFUSED)
def test_invalid_arguments_are_refused(message):
    with pytest.raises(beeline.Error, match=message):
        REFUSED[message]()
