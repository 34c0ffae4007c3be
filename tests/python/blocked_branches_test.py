"""Lines in a scene: other branches and motions aside in place of blocked ones."""

import beeline
import numpy as np
import pytest


def test_a_branch_that_is_blocked_gives_way_to_another():
    arm = beeline.Arm.load("puma560")
    q = np.full(6, 0.3)
    line = [beeline.forward_kinematics(arm, q), beeline.forward_kinematics(arm, q + 0.15)]
    best = beeline.move_in_lines(arm, None, line)
    pose = np.eye(4)
    pose[:3, 3] = beeline.link_poses(arm, best.trajectory.positions[0])[3, :3, 3]  # of the elbow
    links = [beeline.LinkShapes(f"link{i}", i, [beeline.Shape(beeline.Sphere(0.02))]) for i in range(1, 7)]
    ball = beeline.Obstacle("ball", [beeline.Shape(beeline.Sphere(0.05), pose)])
    model = beeline.CollisionModel(arm, links, beeline.Scene([ball]), self_collision=False)
    motion = beeline.move_in_lines(arm, None, line, blocked_by=model)
    assert motion and beeline.prove_clearance(model, motion.trajectory)
    first = motion.blocked[0]
    assert first.status == "collides" and first.reason.fields["other_body"] == "ball"
    np.testing.assert_array_equal(first.start, best.trajectory.positions[0])
    refused = beeline.move_in_lines(arm, first.start, line[1:], blocked_by=model)
    assert refused.status == "collides" and refused.reason.code == first.reason.code and refused.blocked == []
    with pytest.raises(TypeError, match="blocked_by"):
        beeline.move_in_lines(arm, None, line, blocked_by=[model])


def test_a_redundant_arm_moves_aside():
    arm = beeline.arms.panda()
    start = np.radians([0, -30, 0, -130, 0, 100, 45])
    goal = beeline.forward_kinematics(arm, start)
    goal[1, 3] += 0.4
    pose = np.eye(4)
    pose[:3, 3] = 0.1, 0.2, 0.75
    post = beeline.Obstacle("post", [beeline.Shape(beeline.Capsule(0.04, 1.5), pose)])
    model = beeline.CollisionModel(arm, beeline.read_arm_shapes("panda").links, beeline.Scene([post]))
    best = beeline.move_in_lines(arm, start, [goal])
    assert not beeline.prove_clearance(model, best.trajectory)
    motion = beeline.move_in_lines(arm, start, [goal], blocked_by=model)
    assert motion and beeline.prove_clearance(model, motion.trajectory)
    assert [one.reason.fields["other_body"] for one in motion.blocked] == ["post"]
    path = beeline.lines_through([beeline.forward_kinematics(arm, start), goal])
    assert beeline.plan_path(arm, start, path).spare_clearance == np.inf
    branch = beeline.plan_path(arm, start, path, spare_clearance=model)
    least = min(beeline.spare_clearance(model, q) for segment in branch.segments for q in segment.samples)
    other = beeline.CollisionModel(beeline.arms.iiwa7(), beeline.read_arm_shapes("iiwa7").links, beeline.Scene([post]))
    with pytest.raises(beeline.Error, match="spare_clearance is a model of another arm"):
        beeline.plan_path(arm, start, path, spare_clearance=other)
    assert branch.spare_clearance == pytest.approx(min(least, 0.1), abs=1e-12) and least > 0
