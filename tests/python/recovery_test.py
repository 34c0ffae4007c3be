"""recover: motions that start slightly outside the position limits and lead back within them."""

import beeline
import numpy as np
import pytest

PANDA = beeline.arms.panda()
EXCESS = 0.01


@pytest.fixture
def outside():
    q = PANDA.middle.copy()
    q[3] = PANDA.upper[3] + EXCESS
    return q


def expect_recovery(motion, outside):
    assert motion, motion.reason
    recovery, q = motion.recovery, motion.trajectory.positions
    assert recovery.joint == "joint4" and recovery.excess == pytest.approx(EXCESS)
    assert recovery.time == motion.trajectory.times[recovery.sample]
    assert q[0].tolist() == outside.tolist()
    assert (np.diff(q[: recovery.sample + 1, 3]) <= 0).all()
    assert q[recovery.sample :, 3].max() <= PANDA.upper[3] + 1e-9
    assert beeline.recovery_of(PANDA, motion.trajectory) == recovery
    assert beeline.verify(PANDA, motion.trajectory, recover=EXCESS).recovery == recovery
    assert beeline.verify(PANDA, motion.trajectory).fault == "limits"
    assert beeline.verify(PANDA, motion.trajectory).recovery is None
    assert not beeline.verify(PANDA, motion.trajectory, recover=EXCESS / 2)


def test_joint_moves_lines_and_paths_recover(outside):
    back = beeline.nearest_within_limits(PANDA, outside)
    assert back[3] == PANDA.upper[3] and np.delete(back - outside, 3).tolist() == [0] * 6
    expect_recovery(beeline.move_joints(PANDA, outside, PANDA.middle, recover=0.02), outside)
    waypoints = [outside, PANDA.middle, PANDA.middle + 0.1]
    assert not beeline.move_through(PANDA, waypoints)
    expect_recovery(beeline.move_through(PANDA, waypoints, recover=0.02), outside)
    goal = [beeline.forward_kinematics(PANDA, back - [0, 0, 0, 0.2, 0, 0, 0])]
    with pytest.raises(beeline.Error, match="the motion cannot start: joint joint4"):
        beeline.move_in_lines(PANDA, outside, goal)
    line = beeline.move_in_lines(PANDA, outside, goal, recover=0.02)
    expect_recovery(line, outside)
    assert beeline.verify(PANDA, line.trajectory, goal, recover=0.02)
    assert not beeline.verify(PANDA, line.trajectory, goal)


def test_without_an_excess_there_is_none():
    motion = beeline.move_joints(PANDA, PANDA.middle, PANDA.middle + 0.1, recover=0.02)
    assert motion and motion.recovery is None and beeline.recovery_of(PANDA, motion.trajectory) is None
    assert beeline.slight_excess(PANDA) == pytest.approx(1e-4 * (PANDA.upper - PANDA.lower).min())


@pytest.mark.parametrize("wrong", [-1e-9, 0.2, 1e300, np.inf, np.nan])
def test_amounts_out_of_range_are_refused(outside, wrong):
    motion = beeline.move_joints(PANDA, PANDA.middle, PANDA.middle + 0.1).trajectory
    for call in (
        lambda: beeline.move_joints(PANDA, outside, PANDA.middle, recover=wrong),
        lambda: beeline.move_through(PANDA, [outside, PANDA.middle], recover=wrong),
        lambda: beeline.move_in_lines(PANDA, PANDA.middle, [PANDA.tool], recover=wrong),
        lambda: beeline.verify(PANDA, motion, recover=wrong),
    ):
        with pytest.raises(beeline.Error, match="recover must be from 0 to 0.1|recover"):
            call()


def test_a_loop_refuses_a_velocity_beyond_the_limits():
    servo = beeline.Servo(PANDA)
    servo.set_velocity(PANDA.velocity)
    with pytest.raises(beeline.Error, match="velocity of joint joint2 .* above its limit of 2.175"):
        servo.set_velocity([0, -3, 0, 0, 0, 0, 0])
