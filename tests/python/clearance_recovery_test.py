"""recover_clearance: motions that start closer to an obstacle than the clearance, or in contact, and lead out."""

import beeline
import numpy as np
import pytest

ARM = beeline.arms.panda()
SHAPES = beeline.read_arm_shapes("panda").links
LOW = np.radians([-40, 50.5, 0, -120, 0, 170, 45])
GOAL = np.radians([30, 0, 0, -120, 0, 120, 45])


def model_with_table(distance, others=()):
    """The arm at LOW above a table, at a distance of its nearest pair, with a clearance of 5 mm."""

    def scene(top):
        pose = np.eye(4)
        pose[:3, 3] = [0.3, 0, top - 0.05]
        return beeline.Scene([beeline.Obstacle("table", [beeline.Shape(beeline.Box([1.5, 1.5, 0.1]), pose)]), *others])

    options = {"clearance": 0.005, "self_collision": False}
    gap = beeline.nearest_pair(beeline.CollisionModel(ARM, SHAPES, scene(-0.01), **options), LOW).lower
    return beeline.CollisionModel(ARM, SHAPES, scene(-0.01 + gap - distance), **options)


@pytest.mark.parametrize("distance", [0.003, -0.002])
def test_a_motion_leads_out(distance):
    model = model_with_table(distance)
    near = beeline.nearest_pair(model, LOW)
    assert near.lower == pytest.approx(distance, abs=1e-9)
    assert not beeline.move_around(model, LOW, [GOAL])
    motion = beeline.move_around(model, LOW, [GOAL], recover_clearance=0.01)
    assert motion, motion.reason
    recovery = motion.clearance.recovery
    assert recovery.names == near.names and recovery.pairs >= 1
    assert recovery.depth == pytest.approx(0.005 - distance, abs=1e-9)
    assert recovery.distance == pytest.approx(distance, abs=1e-9)
    assert recovery.time == motion.trajectory.times[recovery.sample]
    assert np.array_equal(motion.path.waypoints[0], LOW) and motion.trajectory.positions[0].tolist() == LOW.tolist()
    lowest = [beeline.nearest_pair(model, q).lower for q in motion.trajectory.positions]
    assert min(lowest) >= distance - 1e-9 and min(lowest[recovery.sample :]) >= 0.005
    assert beeline.prove_clearance(model, motion.trajectory, recover_clearance=0.01).recovery == recovery
    assert not beeline.prove_clearance(model, motion.trajectory)
    too_little = beeline.prove_clearance(model, motion.trajectory, recover_clearance=0.001)
    assert too_little.status in ("collides", "not_decided") and too_little.recovery.depth == recovery.depth


@pytest.mark.parametrize("distance", [0.003, -0.002])
def test_a_line_leads_out(distance):
    model = model_with_table(distance)
    begin = beeline.forward_kinematics(ARM, LOW)
    up, down = begin.copy(), begin.copy()
    up[2, 3] += 0.1
    down[2, 3] -= 0.001
    blocked = beeline.move_in_lines(ARM, LOW, [up], blocked_by=model)
    assert blocked.status == "collides" and blocked.reason.code in ("bodies_too_close", "bodies_collide")
    too_little = beeline.move_in_lines(ARM, LOW, [up], blocked_by=model, recover_clearance=0.001)
    assert too_little.status == "collides"
    motion = beeline.move_in_lines(ARM, LOW, [up], blocked_by=model, recover_clearance=0.01)
    assert motion, motion.reason
    proof = beeline.prove_clearance(model, motion.trajectory, recover_clearance=0.01)
    assert proof and proof.recovery.depth == pytest.approx(0.005 - distance, abs=1e-9)
    assert not beeline.prove_clearance(model, motion.trajectory)
    assert not beeline.move_in_lines(ARM, LOW, [down, up], blocked_by=model, recover_clearance=0.01)


def test_a_redundant_arm_moves_aside_of_another_obstacle_too(rng):
    up = beeline.forward_kinematics(ARM, LOW)
    up[2, 3] += 0.3
    free = beeline.move_in_lines(ARM, LOW, [up])
    elbow = beeline.link_poses(ARM, free.trajectory.positions[-1])[4][:3, 3]
    aside = 0
    for _ in range(12):
        place = np.eye(4)
        place[:3, 3] = elbow + rng.uniform(-0.1, 0.1, 3)
        ball = beeline.Obstacle("ball", [beeline.Shape(beeline.Sphere(0.03), place)])
        model = model_with_table(0.02, [ball])
        motion = beeline.move_in_lines(ARM, LOW, [up], blocked_by=model)
        if not motion or not motion.blocked:
            continue
        close = model_with_table(0.003, [ball])
        motion = beeline.move_in_lines(ARM, LOW, [up], blocked_by=close, recover_clearance=0.01)
        assert motion, motion.reason
        assert beeline.prove_clearance(close, motion.trajectory, recover_clearance=0.01).recovery.names[1] == "table"
        aside += 1
    assert aside > 1


def test_a_motion_without_a_start_starts_clear():
    up = beeline.forward_kinematics(ARM, LOW)
    with pytest.raises(beeline.Error, match="recover_clearance needs a start"):
        beeline.move_in_lines(ARM, None, [up, up], blocked_by=model_with_table(0.05), recover_clearance=0.01)


def test_a_line_recovers_from_what_blocks_it_alone():
    with pytest.raises(beeline.Error, match="recover_clearance needs blocked_by"):
        beeline.move_in_lines(ARM, LOW, [beeline.forward_kinematics(ARM, GOAL)], recover_clearance=0.01)
    program = beeline.Program([beeline.Move("joint", q=GOAL)])
    with pytest.raises(beeline.Error, match="recover_clearance needs a start and a model"):
        beeline.move_program(ARM, LOW, program, recover_clearance=0.01)


def test_a_start_that_is_clear_has_no_recovery():
    model = model_with_table(0.05)
    motion = beeline.move_around(model, LOW, [GOAL], recover_clearance=0.01)
    assert motion and motion.clearance.recovery is None


@pytest.mark.parametrize("value", [-1e-9, 0.11, float("nan"), float("inf")])
def test_depths_out_of_range_are_refused(value):
    model = model_with_table(0.05)
    still = beeline.Trajectory(ARM.joint_names, [0, 1], [LOW, LOW])
    with pytest.raises(beeline.Error, match="recover_clearance"):
        beeline.prove_clearance(model, still, recover_clearance=value)
    with pytest.raises(beeline.Error, match="recover_clearance"):
        beeline.move_around(model, LOW, [LOW], recover_clearance=value)
    with pytest.raises(beeline.Error, match="recover_clearance"):
        beeline.move_in_lines(ARM, LOW, [beeline.forward_kinematics(ARM, GOAL)], blocked_by=model, recover_clearance=value)
