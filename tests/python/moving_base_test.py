"""Arms on rails and mobile bases."""

import numpy as np
import pytest

import beeline


@pytest.fixture
def random():
    return np.random.default_rng(7)


def test_a_rail_translates_the_arm(random):
    for name in ("ur5", "panda", "scara"):
        arm = beeline.Arm.load(name)
        for axis, unit in (("y", [0, 1, 0]), ([3, 0, -4], [0.6, 0, -0.8]), (np.array([0, 0, 9]), [0, 0, 1])):
            rail = arm.with_rail(axis, -0.5, 2)
            assert rail.joint_names == ["rail", *arm.joint_names]
            d, q = random.uniform(-0.5, 2), arm.random(seed=3)
            expected = beeline.forward_kinematics(arm, q)
            expected = np.array(expected)
            expected[:3, 3] += d * np.array(unit)
            np.testing.assert_allclose(beeline.forward_kinematics(rail, [d, *q]), expected, atol=1e-12)
            assert rail.joints[0].limits.lower == -0.5 and rail.joints[0].limits.upper == 2


def test_a_mobile_base_moves_the_arm_in_the_plane(random):
    arm = beeline.Arm.load("ur5").with_mount([0.2, 0, 0.5])
    robot = arm.with_mobile_base([-2, 2], (-1, 1), heading=[-3, 3])
    assert robot.joint_names[:3] == ["base_x", "base_y", "base_heading"]
    for _ in range(20):
        q = robot.random(seed=int(random.integers(1 << 30)))
        base = beeline.pose_of([q[0], q[1], 0, 0, 0, q[2]])
        expected = base @ beeline.forward_kinematics(arm, q[3:])
        np.testing.assert_allclose(beeline.forward_kinematics(robot, q), expected, atol=1e-12)
        found = beeline.inverse_kinematics(robot, expected)
        np.testing.assert_allclose(beeline.forward_kinematics(robot, found.solutions[0]), expected, atol=1e-9)
    assert arm.with_mobile_base([-2, 2], [-1, 1]).joints[2].limits.upper == np.inf


def test_the_arm_is_one_like_any_other():
    rail = beeline.Arm.load("ur5").with_rail("x", 0, 3).with_limits({"rail": {"velocity": 1.5}})
    assert rail.joints[0].limits.velocity == 1.5
    assert beeline.Arm.from_json(rail.to_json()) == rail
    poses = [beeline.pose_of([x, 0.4, 0.4, np.pi, 0, 0]) for x in (0.5, 2.8)]
    start = beeline.inverse_kinematics(rail, poses[0]).solutions[0]
    motion = beeline.move_in_lines(rail, start, poses[1:])
    assert motion.status == "reached"
    assert motion.trajectory.joint_names[0] == "rail"


def test_shapes_are_carried(random):
    arm, links = beeline.Arm.load("ur5"), beeline.read_arm_shapes("ur5").links
    alone = beeline.CollisionModel(arm, links)
    for moving, added in ((arm.with_rail("x", 0, 2), 1), (arm.with_mobile_base([0, 2], [0, 2]), 3)):
        carried = beeline.behind_joints(links, added)
        assert [body.link for body in carried] == [body.link + added for body in links]
        model = beeline.CollisionModel(moving, carried)
        assert model.neighbour_pairs == alone.neighbour_pairs
        for seed in range(20):
            q = arm.random(seed=seed)
            at = [*random.uniform(0, 2, added), *q]
            assert beeline.spare_clearance(model, at) == pytest.approx(beeline.spare_clearance(alone, q), abs=1e-9)


def test_bad_arguments_are_refused():
    arm = beeline.Arm.load("ur5")
    for call, says in ((lambda: arm.with_rail("w", 0, 1), "axis"), (lambda: arm.with_rail([0, 0, 0], 0, 1), "the axis of a rail"),
                       (lambda: arm.with_rail("x", 1, 0), "rail"), (lambda: arm.with_rail([np.nan, 0, 1], 0, 1), "axis"),
                       (lambda: arm.with_mobile_base([0, np.inf], [0, 1]), "x has a value that is not finite"),
                       (lambda: arm.with_rail("x", 0, np.inf), "upper has a value that is not finite"),
                       (lambda: arm.with_rail("x", -np.inf), "lower has a value that is not finite"),
                       (lambda: beeline.behind_joints([], 101), "101 joints are too many"),
                       (lambda: arm.with_mobile_base([0, 1], [1, 0]), "base_y")):  # fmt: skip
        with pytest.raises(beeline.Error, match=says):
            call()
    for call in (lambda: arm.with_rail("x", "0", 1), lambda: arm.with_mobile_base([0, 1, 2], [0, 1]),
                 lambda: arm.with_rail(3, 0, 1), lambda: arm.with_mobile_base(3, [0, 1])):  # fmt: skip
        with pytest.raises((beeline.Error, TypeError)):
            call()


def test_ranges_are_optional():
    arm = beeline.Arm.load("ur5")
    for limits in (arm.with_rail("x").joints[0].limits, arm.with_rail("x", None, None).joints[0].limits,
                   *(joint.limits for joint in arm.with_mobile_base().joints[:3])):  # fmt: skip
        assert (limits.lower, limits.upper) == (-np.inf, np.inf)
    assert arm.with_rail("x", upper=2).joints[0].limits.upper == 2
    assert arm.with_mobile_base(y=[0, 1]).joints[1].limits.lower == 0
