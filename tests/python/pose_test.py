"""Poses, rotations and angles: laws over random cases, and what is refused."""

import pickle

import beeline
import numpy as np
import pytest

TOLERANCE = 1e-12


def random_pose(rng):
    return beeline.make_pose(rng.uniform(-2, 2, 3), rotation_vector=rng.uniform(-1.7, 1.7, 3))


def axis_rotation(axis, angle):
    rotation = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    rotation[i, i] = rotation[j, j] = np.cos(angle)
    rotation[j, i], rotation[i, j] = np.sin(angle), -np.sin(angle)
    return rotation


def test_roll_pitch_yaw_is_about_fixed_axes(rng):
    for roll, pitch, yaw in rng.uniform(-1.5, 1.5, (50, 3)):
        expected = axis_rotation(2, yaw) @ axis_rotation(1, pitch) @ axis_rotation(0, roll)
        pose = beeline.make_pose([1, 2, 3], rpy=(roll, pitch, yaw))
        assert np.abs(pose[:3, :3] - expected).max() < TOLERANCE
        assert pose[:3, 3].tolist() == [1, 2, 3] and pose[3].tolist() == [0, 0, 0, 1]
        angles = beeline.roll_pitch_yaw(pose)
        assert np.allclose([angles.roll, angles.pitch, angles.yaw], [roll, pitch, yaw], atol=1e-12)
        assert np.abs(beeline.rotation(angles) - expected).max() < TOLERANCE


def test_quaternions_have_named_parts(rng):
    for angle in rng.uniform(-3, 3, 50):
        q = beeline.quaternion(axis_rotation(0, angle))
        sign = 1 if np.cos(angle / 2) >= 0 else -1
        expected = [sign * np.cos(angle / 2), sign * np.sin(angle / 2), 0, 0]
        assert np.abs(np.array([q.qw, q.qx, q.qy, q.qz]) - expected).max() < TOLERANCE
        for given in (q, (q.qw, q.qx, q.qy, q.qz)):
            pose = beeline.make_pose([0, 0, 0], quaternion=given)
            assert np.abs(pose[:3, :3] - axis_rotation(0, angle)).max() < TOLERANCE
    assert repr(beeline.Quaternion()) == "Quaternion(qw=1.0, qx=0.0, qy=0.0, qz=0.0)"
    assert pickle.loads(pickle.dumps(q)) == q


def test_exponentials_and_logarithms_are_inverse(rng):
    for _ in range(50):
        pose = random_pose(rng)
        assert np.abs(beeline.se3_exp(beeline.se3_log(pose)) - pose).max() < TOLERANCE
        vector = beeline.so3_log(pose)
        assert np.abs(beeline.so3_exp(vector) - pose[:3, :3]).max() < TOLERANCE
        left = beeline.so3_left_jacobian(vector)
        assert np.abs(left @ beeline.so3_left_jacobian_inverse(vector) - np.eye(3)).max() < TOLERANCE
        assert np.abs(beeline.inverse(pose) @ pose - np.eye(4)).max() < TOLERANCE


def test_the_adjoint_moves_twists_between_frames(rng):
    for _ in range(50):
        pose, twist = random_pose(rng), rng.uniform(-1, 1, 6)
        moved = beeline.adjoint(pose, twist)
        assert np.abs(beeline.adjoint(pose) @ twist - moved).max() < TOLERANCE
        expected = pose @ beeline.se3_exp(twist) @ beeline.inverse(pose)
        assert np.abs(beeline.se3_exp(moved) - expected).max() < 1e-11
        assert np.abs(beeline.hat(twist[3:]) @ twist[:3] - np.cross(twist[3:], twist[:3])).max() < TOLERANCE


def test_lines_between_poses(rng):
    start, end = random_pose(rng), random_pose(rng)
    s = np.linspace(0, 1, 5)
    line = beeline.interpolate(start, end, s)
    assert line.shape == (5, 4, 4) and beeline.interpolate(start, end, 0.5).shape == (4, 4)
    assert np.abs(line[0] - start).max() < TOLERANCE and np.abs(line[-1] - end).max() < TOLERANCE
    whole = beeline.pose_difference(end, start)
    for fraction, pose in zip(s, line):
        assert np.abs(beeline.pose_difference(pose, start) - fraction * whole).max() < 1e-11


def test_angles_of_numbers_and_arrays(rng):
    angles = rng.uniform(-20, 20, (3, 4))
    wrapped = beeline.wrap_angle(angles)
    assert wrapped.shape == (3, 4) and np.abs(wrapped).max() <= np.pi
    assert np.abs(np.exp(1j * wrapped) - np.exp(1j * angles)).max() < TOLERANCE
    assert type(beeline.wrap_angle(7)) is float
    assert np.abs(beeline.angle_difference(angles, 1.0) - beeline.wrap_angle(angles - 1)).max() < 1e-11
    nearest = beeline.nearest_angle(angles, 100.0)
    assert np.abs(nearest - 100).max() <= np.pi + 1e-9
    with pytest.raises(beeline.Error, match=r"a and b have the shapes \(2,\) and \(3,\)"):
        beeline.angle_difference([1, 2], [1, 2, 3])


def test_planar_poses_compose_as_spatial_ones(rng):
    for _ in range(20):
        a, b = (beeline.Pose2(x=x, y=y, theta=t) for x, y, t in rng.uniform(-3, 3, (2, 3)))
        assert np.abs(beeline.to_space(a @ b) - beeline.to_space(a) @ beeline.to_space(b)).max() < TOLERANCE
        back = beeline.to_plane(beeline.to_space(a, height=2))
        assert np.allclose([back.x, back.y, back.theta], [a.x, a.y, a.theta])
        assert np.abs(beeline.to_space(beeline.se2_exp(beeline.se2_log(a))) - beeline.to_space(a)).max() < TOLERANCE
        assert np.abs(beeline.to_space(a @ a.inverse()) - np.eye(4)).max() < TOLERANCE
        assert beeline.pose_difference(a, b)[0] == a.x - b.x
    with pytest.raises(TypeError):
        a @ 3


class OtherPose:
    """As scipy's RigidTransform and pinocchio's SE3."""

    def __init__(self, name, value):
        setattr(self, name, value)


def test_poses_of_other_libraries_are_taken(rng):
    pose = random_pose(rng)
    for other in (OtherPose("homogeneous", pose), OtherPose("A", pose), OtherPose("as_matrix", lambda: pose)):
        assert np.array_equal(beeline.se3_log(other), beeline.se3_log(pose))
        assert np.array_equal(beeline.so3_log(other), beeline.so3_log(pose))
    turned = OtherPose("as_matrix", lambda: pose[:3, :3])
    assert np.array_equal(beeline.so3_log(turned), beeline.so3_log(pose))
    assert np.array_equal(beeline.make_pose(pose[:3, 3], turned), beeline.make_pose(pose[:3, 3], pose))


HALF = np.diag([1, 1, 0.5, 1.0])


@pytest.mark.parametrize(
    "call, error, message",
    [
        (lambda: beeline.se3_log(np.eye(3)), beeline.Error, r"pose has the shape \(3, 3\); expected a pose \(4, 4\)"),
        (lambda: beeline.se3_log(HALF), beeline.Error, "pose"),
        (lambda: beeline.se3_log(np.eye(4) * np.nan), beeline.Error, "pose"),
        (lambda: beeline.se3_log("pose"), TypeError, "pose"),
        (lambda: beeline.se3_log(object()), TypeError, "pose"),
        (lambda: beeline.se3_log(np.eye(4, dtype=complex)), TypeError, "pose"),
        (lambda: beeline.so3_log(np.zeros((3, 3))), beeline.Error, "rotation"),
        (lambda: beeline.so3_log(np.zeros((2, 2))), beeline.Error, r"expected \(3, 3\) or \(4, 4\)"),
        (lambda: beeline.so3_exp([1, 2]), beeline.Error, r"rotation_vector has the shape \(2,\); expected \(3,\)"),
        (lambda: beeline.so3_exp([1, 2, np.inf]), beeline.Error, "rotation_vector has a value that is not finite"),
        (lambda: beeline.make_pose([1, 2]), beeline.Error, "position"),
        (lambda: beeline.make_pose([1, 2, np.nan]), beeline.Error, "finite"),
        (lambda: beeline.make_pose([1, 2, 3], np.eye(3), rpy=(0, 0, 0)), beeline.Error, "more than one of rotation"),
        (lambda: beeline.make_pose([1, 2, 3], quaternion=(1, 1, 0, 0)), beeline.Error, "quaternion"),
        (lambda: beeline.make_pose([1, 2, 3], quaternion=(1, 0, 0)), beeline.Error, "quaternion"),
        (lambda: beeline.rotation_from_quaternion(2, 0, 0, 0), beeline.Error, "quaternion"),
        (lambda: beeline.rotation_from_quaternion("1", 0, 0, 0), TypeError, "qw: expected a number, not str"),
        (lambda: beeline.interpolate(np.eye(4), np.eye(4), [0, np.nan]), beeline.Error, "s has a value"),
        (lambda: beeline.Pose2(x="a"), TypeError, "x: expected a number, not str"),
        (lambda: beeline.wrap_angle("a"), TypeError, "radians"),
    ],
)
def test_what_is_not_a_pose_is_refused(call, error, message):
    with pytest.raises(error, match=message):
        call()


def test_orientations_become_tuples_and_arrays():
    pose = beeline.make_pose([0, 0, 0], rpy=[0.1, 0.2, 0.3])
    quaternion, angles = beeline.quaternion(pose[:3, :3]), beeline.roll_pitch_yaw(pose[:3, :3])
    assert tuple(quaternion) == (quaternion.qw, quaternion.qx, quaternion.qy, quaternion.qz)
    array = np.array(angles)
    assert array.dtype == np.float64
    np.testing.assert_allclose(array, [0.1, 0.2, 0.3], atol=1e-15)
    assert np.asarray(quaternion, dtype=np.float32).dtype == np.float32
