"""Poses of scipy, spatialmath and pinocchio: as arguments, one or a list of them, and there and back."""

import os
import random

import numpy as np
import pytest

beeline = pytest.importorskip("beeline")
from scipy.spatial.transform import RigidTransform, Rotation  # noqa: E402

SEED = int(os.environ.get("BEELINE_SEED", random.randrange(10**6)))


@pytest.fixture
def matrices():
    print("seed", SEED)
    rng = np.random.default_rng(SEED)
    poses = np.tile(np.eye(4), (5, 1, 1))
    poses[:, :3, :3] = Rotation.random(5, rng).as_matrix()
    poses[:, :3, 3] = rng.uniform(-1, 1, (5, 3))
    return poses


def scipy_object(poses):
    return RigidTransform.from_matrix(poses)


def spatialmath_object(poses):
    spatialmath = pytest.importorskip("spatialmath")
    return spatialmath.SE3(poses if poses.ndim == 2 else list(poses), check=False)


def pinocchio_object(poses):
    pin = pytest.importorskip("pinocchio")
    return pin.SE3(poses) if poses.ndim == 2 else [pin.SE3(pose) for pose in poses]


MAKERS = [scipy_object, spatialmath_object, pinocchio_object]
CONVERSIONS = ["to_rigid_transform", "to_spatialmath", "to_pinocchio"]


@pytest.mark.parametrize("make", MAKERS)
def test_as_arguments(make, matrices):
    arm = beeline.arms.panda()
    assert np.allclose(arm.with_tool(make(matrices[0])).tool, matrices[0], atol=1e-14)
    assert np.allclose(arm.with_mount(make(matrices[1])).base, matrices[1], atol=1e-14)
    goals = beeline.forward_kinematics(arm, np.linspace(arm.lower, arm.upper, 7)[1:6])
    one = beeline.inverse_kinematics(arm, make(goals[0]), seed=arm.middle)
    same = beeline.inverse_kinematics(arm, goals[0], seed=arm.middle)
    assert one and np.allclose(one.solutions, same.solutions, atol=1e-9)
    many = beeline.batch_inverse(arm, make(goals))
    for given in (many, beeline.batch_inverse(arm, [make(goal) for goal in goals])):
        reached = beeline.forward_kinematics(arm, given.q)
        assert np.allclose(reached, goals, atol=1e-6)


@pytest.mark.parametrize("make", MAKERS)
def test_many_as_arguments(make, matrices):
    arm = beeline.arms.ur5()
    start = np.array([0.3, -1.2, 1.4, -1.0, -1.5, 0.2])
    tool = beeline.forward_kinematics(arm, start)
    goals = np.tile(tool, (3, 1, 1))
    goals[:, :3, 3] += [[0.02, 0, 0], [0.02, 0.03, 0], [0, 0.03, 0.01]]
    expected = beeline.move_in_lines(arm, start, goals)
    assert expected
    for given in [make(goals), [make(goal) for goal in goals], tuple(make(goal) for goal in goals)]:
        motion = beeline.move_in_lines(arm, start, given)
        assert np.allclose(motion.trajectory.positions[-1], expected.trajectory.positions[-1], atol=1e-9)
    pictures = [beeline.draw(arm, expected, waypoints=given) for given in (goals, make(goals))]
    assert pictures[0].width == pictures[1].width


@pytest.mark.parametrize("make, back", list(zip(MAKERS, CONVERSIONS)))
def test_there_and_back(make, back, matrices):
    for poses in (matrices, matrices[0], matrices[:1]):
        converted = getattr(beeline.poses, back)(poses)
        assert isinstance(converted, type(make(poses)))
        again = beeline.poses.from_any(converted)
        assert again.shape in (poses.shape, poses[0].shape) and np.allclose(again, poses, atol=1e-14)
        assert np.allclose(beeline.poses.from_any(make(poses)), poses, atol=1e-14)
    for items in ([make(pose) for pose in matrices], tuple(make(pose) for pose in matrices)):
        assert np.allclose(beeline.poses.from_any(items), matrices, atol=1e-14)


def test_orientations(matrices):
    rotation = beeline.poses.to_rotation(matrices)
    assert np.allclose(rotation.as_matrix(), matrices[:, :3, :3])
    assert np.allclose(beeline.poses.from_any(rotation, matrices[:, :3, 3]), matrices, atol=1e-14)
    assert np.array_equal(beeline.poses.from_any(rotation)[:, :3, 3], np.zeros((5, 3)))
    assert beeline.poses.to_rotation(matrices[0]).magnitude() == pytest.approx(rotation[0].magnitude())


def test_vectors_of_pinocchio(matrices):
    pin = pytest.importorskip("pinocchio")
    vector = pin.StdVec_SE3()
    for pose in matrices:
        vector.append(pin.SE3(pose))
    assert np.allclose(beeline.poses.from_any(vector), matrices, atol=1e-14)


def test_orientations_alone_are_no_poses(matrices):
    with pytest.raises(beeline.Error, match=r"\(3, 3\)"):
        beeline.arms.panda().with_tool(Rotation.identity())
    for wrong in [np.zeros((2, 3)), [1, 2], np.zeros((2, 2, 4, 4))]:
        with pytest.raises(beeline.Error, match="shape"):
            beeline.poses.from_any(wrong)
