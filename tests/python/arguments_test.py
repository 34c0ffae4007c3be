"""Arguments: one line that names the argument and the cure; the same functions as methods of an arm."""

import beeline
import numpy as np
import pytest
from moved import moved

PANDA = beeline.arms.panda()
Q = np.array([0, -0.5, 0.1, -2, 0.2, 1.6, 0.7])
POSE = beeline.forward_kinematics(PANDA, Q)
MOTION = beeline.move_in_lines(PANDA, Q, [moved(POSE, 0, 0, 0.02)])


@pytest.mark.parametrize("call", [
    lambda arm: beeline.forward_kinematics(arm, Q),
    lambda arm: beeline.jacobian(arm, Q),
    lambda arm: beeline.inverse_kinematics(arm, POSE),
    lambda arm: beeline.inverse_method(arm),
    lambda arm: beeline.move_in_lines(arm, Q, [POSE]),
    lambda arm: beeline.move_joints(arm, Q, Q),
    lambda arm: beeline.limit_usage(arm, MOTION.trajectory),
    lambda arm: beeline.view(arm),
    lambda arm: beeline.draw(arm, Q),
    lambda arm: beeline.random_configuration(arm),
])  # fmt: skip
def test_what_is_no_arm_is_refused_by_a_line_that_says_how_to_get_one(call):
    for wrong, cure in (("RRR:1,1,1", r"beeline.Arm.load\('RRR:1,1,1'\) makes one"), ("my.urdf", r"beeline.Arm.load\('my.urdf'\)"),
                        (None, r"beeline.arms.panda\(\) makes one"), (Q, "not ndarray")):  # fmt: skip
        with pytest.raises(TypeError, match=r"^arm: expected an Arm, not ") as error:
            call(wrong)
        assert error.match(cure) and "\n" not in str(error.value)


def test_other_objects_are_refused_alike():
    with pytest.raises(TypeError, match="^trajectory: expected a Trajectory, not PathMotion; take its trajectory$"):
        beeline.limit_usage(PANDA, MOTION)
    with pytest.raises(TypeError, match="^recording: expected a Trajectory, not str$"):
        beeline.replay(PANDA, "move.csv")
    with pytest.raises(TypeError, match="^route: expected a Route, not list$"):
        beeline.move_along(PANDA, None, [POSE])
    with pytest.raises(TypeError, match="^trajectory: expected a Trajectory or a result that has one, not float$"):
        beeline.view(PANDA, Q, 1.5)


def test_frames_of_other_libraries_are_refused_with_the_meaning_of_ours():
    for wrong in ("world", "WORLD", "body"):
        with pytest.raises(beeline.Error, match=f'unknown frame "{wrong}" .*base, tool, space.*world\'s axes'):
            PANDA.jacobian(Q, wrong)


def test_methods_are_the_functions_of_the_arm():
    for name, arguments, keywords in [
        ("forward_kinematics", (Q,), {"layout": "position_quaternion"}),
        ("link_poses", (Q,), {}),
        ("jacobian", (Q, "tool"), {}),
        ("manipulability", (Q,), {}),
        ("random_configuration", (5,), {"seed": 3}),
    ]:
        function, method = getattr(beeline, name), getattr(PANDA, name)
        assert np.array_equal(function(PANDA, *arguments, **keywords), method(*arguments, **keywords))
        assert method.__doc__.split("\n\n")[1] == function.__doc__.split("\n\n")[1]
    for name, arguments, keywords in [
        ("inverse_kinematics", (POSE,), {"seed": Q}),
        ("inverse_kinematics", ([POSE, POSE],), {"seed": Q}),
        ("inverse_method", (), {"method": "numerical"}),
        ("move_joints", (Q, GOAL), {"rate": 100}),
        ("move_in_lines", (None, [POSE, moved(POSE, 0, 0, 0.02)]), {"rate": 100}),
        ("joint_rates", (Q, [0.1, 0, 0, 0, 0, 0]), {}),
    ]:
        assert getattr(PANDA, name)(*arguments, **keywords) == getattr(beeline, name)(PANDA, *arguments, **keywords)


@pytest.mark.parametrize("name", beeline.arms.names())
def test_random_configurations_are_within_the_limits(name):
    arm = beeline.Arm.load(name)
    rows = arm.random_configuration(200, seed=7)
    assert rows.shape == (200, arm.dof) and np.array_equal(rows, arm.random_configuration(200, seed=7))
    assert not np.array_equal(rows, arm.random_configuration(200, seed=8))
    assert (rows >= arm.lower).all() and (rows <= arm.upper).all() and np.abs(rows).max() < 10
    spread = np.minimum(arm.upper, 2 * np.pi) - np.maximum(arm.lower, -2 * np.pi)
    assert (np.ptp(rows, axis=0) > 0.3 * np.minimum(spread, 2)).all()
    assert np.array_equal(arm.random(200, 7), rows) and arm.random().shape == (arm.dof,)
    one = arm.random_configuration()
    assert one.shape == (arm.dof,) and not np.array_equal(one, arm.random_configuration())


DRAWN = [[-1.3356310477049878, -0.09150364050644066, 2.068079644364992, -1.2726555178388852, -0.5469091262673933,
          1.0929755530455545, 2.0302159030981977],
         [2.8394181649861436, -0.5310804311325701, 1.400462814923896, -1.7015225854535114, 1.340235497495407,
          0.8611665714184806, -2.1661565087243884]]  # fmt: skip


def test_a_seed_gives_the_same_numbers_on_every_system():
    assert PANDA.random(2, seed=20240229).tolist() == DRAWN


def test_random_configurations_refuse_what_they_cannot_draw():
    for wrong in (-1, 10**9):
        with pytest.raises(beeline.Error, match="count must be from 0"):
            PANDA.random_configuration(wrong)
    with pytest.raises((TypeError, beeline.Error), match="seed"):
        PANDA.random_configuration(seed="x")
    assert PANDA.random_configuration(0).shape == (0, 7)


def test_results_with_a_trajectory_have_its_duration():
    assert MOTION.duration == MOTION.trajectory.duration > 0
    assert beeline.retime(PANDA, MOTION.trajectory).duration > 0
    assert beeline.control_joints(PANDA, Q, Q).duration == 0
    unreachable = beeline.move_in_lines(PANDA, Q, [moved(POSE, 0, 0, 5)])
    assert not unreachable and unreachable.duration == 0


GOAL = np.array([0.5, 0, 0, -2, 0, 2, 0.3])


def test_a_joint_trajectory_in_one_call():
    motion = beeline.move_joints(PANDA, Q, GOAL, rate=250)
    assert motion and np.array_equal(motion.trajectory.positions[[0, -1]], [Q, GOAL])
    assert motion.trajectory == beeline.sampled(PANDA, beeline.point_to_point(PANDA, Q, GOAL), 250)
    assert np.allclose(np.diff(motion.trajectory.times), 1 / 250, atol=2e-9)
    straight = beeline.move_joints(PANDA, Q, GOAL, synchronise="straight").trajectory.positions
    fraction = ((straight - Q) @ (GOAL - Q)) / ((GOAL - Q) @ (GOAL - Q))
    assert np.allclose(straight, Q + fraction[:, None] * (GOAL - Q), atol=1e-9)


@pytest.mark.parametrize("seconds", [2, 2.5, 3.01, 60])
def test_a_joint_trajectory_of_a_duration(seconds):
    motion = beeline.move_joints(PANDA, Q, GOAL, duration=seconds)
    assert motion and motion.duration == pytest.approx(seconds, abs=1e-9)
    used = beeline.limit_usage(PANDA, motion.trajectory)
    assert max(used.velocity.fraction, used.acceleration.fraction, used.jerk.fraction) <= 1
    assert np.array_equal(motion.trajectory.positions[[0, -1]], [Q, GOAL])


def test_durations_that_cannot_be():
    quickest = beeline.move_joints(PANDA, Q, GOAL)
    assert beeline.move_joints(PANDA, Q, GOAL, duration=quickest.duration).duration == quickest.duration
    short = beeline.move_joints(PANDA, Q, GOAL, duration=quickest.duration - 0.01)
    assert short.status == "outside_limits" and f"{quickest.duration:.6g} s" in short.reason
    for wrong, message in ((2.005, r"2 or 2.01 s, not 2.005"), (0, "above 0"), (np.nan, "above 0"), (-1, "above 0")):
        with pytest.raises(beeline.Error, match=message):
            beeline.move_joints(PANDA, Q, GOAL, duration=wrong)


def test_a_joint_trajectory_leads_back_into_the_limits():
    outside = GOAL.copy()
    outside[3] = PANDA.upper[3] + 0.05
    outside[1] = PANDA.lower[1] - 1e-9
    motion = beeline.move_joints(PANDA, outside, Q)
    assert motion and np.array_equal(motion.trajectory.positions[0], outside)
    excess = np.maximum(motion.trajectory.positions - PANDA.upper, PANDA.lower - motion.trajectory.positions).max(axis=1)
    states = motion.trajectory.sample(np.linspace(0, motion.duration, 2000)).position
    assert (np.diff(states[:, 3]) <= 1e-12).all() and excess[-1] < 0
    outside[3] = PANDA.upper[3] + 0.2
    with pytest.raises(beeline.Error, match="the motion cannot start: joint joint4|joint4"):
        beeline.move_joints(PANDA, outside, Q)


@pytest.mark.parametrize("profile", ["jerk", "fastest", "trapezoidal", "quintic"])
def test_lines_and_retimed_trajectories_of_a_duration(profile):
    way = [moved(POSE, 0.02, 0, 0.05), moved(POSE, 0, 0.05, 0)]
    quick = beeline.move_in_lines(PANDA, Q, way, profile=profile)
    slow = beeline.move_in_lines(PANDA, Q, way, profile=profile, duration=2 * quick.duration)
    assert slow and slow.duration == pytest.approx(2 * quick.duration, abs=2e-9)
    assert slow.limits.velocity.fraction == pytest.approx(quick.limits.velocity.fraction / 2, rel=1e-5)
    assert beeline.verify(PANDA, slow.trajectory, way)
    short = beeline.move_in_lines(PANDA, Q, way, profile=profile, duration=0.9 * quick.duration, suggest=True)
    assert short.status == "outside_limits" and "the shortest within the limits" in short.reason and not short.nearby
    again = beeline.retime(PANDA, quick.trajectory, profile=profile)
    slower = beeline.retime(PANDA, quick.trajectory, profile=profile, duration=again.duration + 1)
    assert slower and slower.duration == pytest.approx(again.duration + 1, abs=2e-9)
    assert "the shortest" in beeline.retime(PANDA, quick.trajectory, duration=0.01).reason
    for call in (lambda **o: beeline.move_in_lines(PANDA, Q, way, **o), lambda **o: beeline.retime(PANDA, quick.trajectory, **o)):
        with pytest.raises(beeline.Error, match="duration cannot be combined with a rate"):
            call(duration=9, rate=100)
        with pytest.raises(beeline.Error, match="duration must be above 0"):
            call(duration=0)


def test_limits_with_a_tolerance():
    motion = MOTION.trajectory
    scale = 1 + 5e-5  # as other planners round
    fast = beeline.Trajectory(motion.joint_names, motion.times / scale, motion.positions, motion.velocities * scale,
                              motion.accelerations * scale**2)  # fmt: skip
    way = [moved(POSE, 0, 0, 0.02)]
    refused = beeline.verify(PANDA, fast, way)
    assert refused.fault in ("velocity", "acceleration", "jerk")
    assert beeline.verify(PANDA, fast, way, limit_tolerance=1e-3)
    assert beeline.verify(PANDA, fast, way, limit_tolerance=1e-6).fault == refused.fault
    for wrong in (-1e-9, 0.2, np.nan):
        with pytest.raises(beeline.Error, match="limit_tolerance must be from 0 to 0.1"):
            beeline.verify(PANDA, fast, way, limit_tolerance=wrong)
        with pytest.raises(beeline.Error, match="limit_tolerance must be from 0 to 0.1"):
            beeline.replay(PANDA, fast, limit_tolerance=wrong)


def test_a_replay_with_a_tolerance_keeps_the_recorded_velocity():
    quick = beeline.move_joints(PANDA, Q, GOAL, rate=1000).trajectory
    used = beeline.limit_usage(PANDA, quick).velocity.fraction
    scale = 1.0005 / used
    fast = beeline.Trajectory(quick.joint_names, quick.times / scale, quick.positions, quick.velocities * scale,
                              quick.accelerations * scale**2)  # fmt: skip
    refused = beeline.replay(PANDA, fast)
    assert refused.status == "outside_limits" and "1.0005 times its velocity limit" in refused.reason
    played = beeline.replay(PANDA, fast, limit_tolerance=1e-3)
    assert played and played.slowdown == pytest.approx(1, abs=3e-6)
    assert played.limits.velocity.fraction == pytest.approx(1.0005, abs=3e-6)
