"""Programs with the motion around obstacles."""

import numpy as np
import pytest

import beeline

PANDA = beeline.arms.panda()


def test_a_move_of_a_program_goes_around(root):
    left, right = [0.6, -0.3, 0, -2.2, 0, 1.9, 0.8], [-0.6, -0.3, 0, -2.2, 0, 1.9, 0.8]
    pose = np.eye(4)
    pose[:3, 3] = 0.45, 0, 0.5
    pillar = beeline.Obstacle("pillar", [beeline.Shape(beeline.Cylinder(radius=0.06, length=1.2), pose)])
    hand = beeline.LinkShapes("hand", 7, [beeline.Shape(beeline.Sphere(0.06))])
    model = beeline.CollisionModel(PANDA, [hand], beeline.Scene([pillar]))
    program = beeline.Program([beeline.Move("around", q=right)])
    motion = beeline.move_program(PANDA, left, program, model)
    assert motion and beeline.verify(PANDA, motion.trajectory, program)
    [move] = motion.moves
    assert len(move.waypoints) > 2 and np.allclose(move.waypoints[-1], right)
    assert beeline.prove_clearance(model, motion.trajectory, program, [move.end])
    straight = beeline.move_program(PANDA, left, beeline.Program([beeline.Move("joint", q=right)]), model=model)
    assert straight and len(straight.moves[0].waypoints) == 0
    assert not beeline.prove_clearance(model, straight.trajectory)
    with pytest.raises(beeline.Error, match=r"move 1 \(around\): a motion around obstacles needs their scene"):
        beeline.move_program(PANDA, left, program)


def test_a_goal_that_is_blocked_is_named_although_a_line_follows():
    arm = beeline.arms.ur5()
    begin = [0, -1.2, 1.4, -1.8, -1.57, 0]
    above = beeline.forward_kinematics(arm, [0.8, -1.2, 1.4, -1.8, -1.57, 0])
    below = above.copy()
    below[2, 3] -= 0.1
    place = np.eye(4)
    place[:3, 3] = above[:3, 3]
    ball = beeline.Obstacle("ball", [beeline.Shape(beeline.Sphere(0.05), place)])
    hand = beeline.LinkShapes("hand", 6, [beeline.Shape(beeline.Sphere(0.03))])
    model = beeline.CollisionModel(arm, [hand], beeline.Scene([ball]))
    motion = beeline.move_program(
        arm, begin, beeline.Program([beeline.Move("around", above), beeline.Move("line", below)]), model
    )
    assert motion.status == "collides" and motion.failed == 0
    assert str(motion.reason).startswith("move 1 (around)") and "hand" in str(motion.reason)
