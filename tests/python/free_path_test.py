"""Paths and motions around obstacles."""

import numpy as np
import pytest

import beeline

ARM = beeline.arms.panda()
START = np.array([0.6, -0.3, 0, -2.2, 0, 1.9, 0.8])
GOAL = np.array([-0.6, -0.3, 0, -2.2, 0, 1.9, 0.8])


@pytest.fixture(scope="module")
def model():
    pillar = beeline.Obstacle("pillar", [beeline.Shape(beeline.Cylinder(0.06, 1.2),
                                                       pose=beeline.pose_of([0.45, 0, 0.5], triple="position"))])
    return beeline.CollisionModel(ARM, beeline.read_arm_shapes("panda").links, beeline.Scene([pillar]))


def test_a_path_is_proved_edge_by_edge(model):
    assert not beeline.prove_clearance(model, beeline.move_joints(ARM, START, GOAL).trajectory)
    path = beeline.find_free_path(model, START, [GOAL], random_seed=3)
    assert path and path.status == "reached" and path.goal == 0
    assert np.array_equal(path.waypoints[0], START) and np.array_equal(path.waypoints[-1], GOAL)
    assert path.length == pytest.approx(sum(map(np.linalg.norm, np.diff(path.waypoints, axis=0))))
    for a, b in zip(path.waypoints, path.waypoints[1:]):
        edge = beeline.Trajectory(ARM.joint_names, [0, 1], [a, b])
        assert beeline.prove_clearance(model, edge)
    assert str(path).startswith(f"reached, {len(path.waypoints)} waypoints, length")
    again = beeline.find_free_path(model, START, [GOAL], random_seed=3)
    assert np.array_equal(again.waypoints, path.waypoints)


def test_a_motion_is_proved(model):
    there = beeline.move_around(model, START, [GOAL, START], rate=200)
    assert there and there.path.goal == 1 and len(there.trajectory) == 1, "the nearest goal is the start"
    motion = beeline.move_around(model, START, [GOAL])
    assert motion and motion.clearance and motion.duration == motion.trajectory.duration
    assert beeline.prove_clearance(model, motion.trajectory)
    assert motion.limits.acceleration.fraction <= 1.0001
    assert len(motion.blends) == len(motion.path.waypoints) - 2
    stops = beeline.move_around(model, START, [GOAL], joint_blend=0)
    assert stops.duration > motion.duration
    slow = beeline.move_around(model, START, [GOAL], speed_scale=0.5)
    assert slow.duration > 1.5 * motion.duration


def test_what_is_refused(model):
    inside = ARM.random(200, 1)
    hits = [q for q in inside if beeline.blocked_by(model, q)]
    path = beeline.find_free_path(model, START, hits[:2])
    assert not path and path.status == "collides" and path.reason.code == "goal_not_free"
    assert path.reason.fields["count"] == 2 and len(path.waypoints) == 0
    path = beeline.find_free_path(model, START, [GOAL], max_edges=1)
    assert path.status == "not_found" and path.reason.code == "no_free_path"
    assert beeline.find_free_path(model, START, [GOAL], max_work=0).status == "work_limit"
    for options in ({"max_edges": 0}, {"shortcuts": -1}):
        with pytest.raises(beeline.Error, match=next(iter(options))):
            beeline.find_free_path(model, START, [GOAL], **options)
    with pytest.raises(beeline.Error, match="joint_blend"):
        beeline.move_around(model, START, [GOAL], joint_blend=-1)
    with pytest.raises(beeline.Error, match="goal"):
        beeline.find_free_path(model, START, [])
