"""One pose or many: inverse_kinematics() has the result that belongs to the shape of the poses."""

import numpy as np
import pytest

import beeline

SEED = 20240229
PANDA, UR5, RRR = beeline.arms.panda(), beeline.arms.ur5(), beeline.arms.rrr()


def poses_of(arm, *shape):
    q = arm.random(int(np.prod(shape)), SEED).reshape(*shape, arm.dof)
    return q, beeline.forward_kinematics(arm, q)


def triples(poses):
    return np.stack([poses[..., 0, 3], poses[..., 1, 3], np.arctan2(poses[..., 1, 0], poses[..., 0, 0])], axis=-1)


@pytest.mark.parametrize("arm", [PANDA, UR5, RRR], ids=lambda arm: arm.name)
@pytest.mark.parametrize("shape", [(5,), (1,), (0,), (2, 3), (2, 1, 4)], ids=str)
def test_the_shape_is_kept(arm, shape):
    q, poses = poses_of(arm, *shape)
    result = beeline.inverse_kinematics(arm, poses, seed=q)
    assert isinstance(result, beeline.BatchInverseResult) and result.q.shape == (*shape, arm.dof)
    assert result and result.solved == np.prod(shape)
    assert np.allclose(beeline.forward_kinematics(arm, result.q), poses, atol=1e-8)
    assert result == beeline.batch_inverse(arm, poses, seed=q) == arm.inverse_kinematics(poses, seed=q)


@pytest.mark.parametrize("shape", [(5,), (1,), (3,), (2, 3)], ids=str)
def test_planar_poses_are_numbers_too(shape):
    q, poses = poses_of(RRR, *shape)
    result = RRR.inverse_kinematics(triples(poses), seed=q)
    assert result.q.shape == q.shape and np.allclose(beeline.forward_kinematics(RRR, result.q), poses, atol=1e-8)
    one = RRR.inverse_kinematics(triples(poses).reshape(-1, 3)[0], seed=q.reshape(-1, 3)[0])
    assert isinstance(one, beeline.InverseResult) and np.allclose(one.q, result.q.reshape(-1, 3)[0], atol=1e-9)


def test_lists_of_poses_are_many():
    q, poses = poses_of(PANDA, 3)
    expected = beeline.batch_inverse(PANDA, poses)
    for many in (list(poses), tuple(poses), poses.tolist(), [pose.tolist() for pose in poses]):
        assert np.allclose(PANDA.inverse_kinematics(many).q, expected.q, atol=1e-9)
    _, flat = poses_of(RRR, 3)
    numbers = triples(flat)
    expected = beeline.batch_inverse(RRR, flat)
    for many in (numbers.tolist(), list(numbers), beeline.to_plane(flat), tuple(beeline.to_plane(flat)), [tuple(row) for row in numbers]):
        assert np.allclose(RRR.inverse_kinematics(many).q, expected.q, atol=1e-9)
    assert PANDA.inverse_kinematics([]).q.shape == (0, 7)


def test_one_pose_is_one():
    for arm in (PANDA, RRR):
        _, (pose,) = poses_of(arm, 1)
        given = [pose, pose.tolist(), tuple(map(tuple, pose)), list(pose), np.asfortranarray(pose)]
        if arm.planar:
            given += [triples(pose), triples(pose).tolist(), tuple(triples(pose)), beeline.to_plane(pose)]
        for one in given:
            result = beeline.inverse_kinematics(arm, one)
            assert isinstance(result, beeline.InverseResult) and result, one


def test_poses_of_no_arm_are_refused():
    for wrong, message in [
        ([0.5, 0, 0.5], r"has the shape \(3,\); expected a pose \(4, 4\), which make_pose"),
        (np.zeros((5, 3)), r"has the shape \(5, 3\); expected a pose \(4, 4\)"),
        (np.zeros((2, 5, 3)), r"has the shape \(2, 5, 3\); expected \(N, 4, 4\)"),
        (beeline.Pose2(x=1, y=0, theta=0), "a Pose2 is for planar arms; a pose of panda is spatial"),
        ([beeline.Pose2(x=1, y=0, theta=0)], "a Pose2 is for planar arms; a pose of panda is spatial"),
    ]:
        with pytest.raises(beeline.Error, match="^world_T_tool:? " + message):
            beeline.inverse_kinematics(PANDA, wrong)
    flat = np.array([[1.0, 0, 4], [0, 1, 5], [0, 0, 1]])
    for wrong in (flat, flat.tolist()):
        with pytest.raises(beeline.Error, match="may be a matrix of SE"):
            beeline.inverse_kinematics(RRR, wrong)
    deep = []
    deep.append(deep)
    for wrong in (deep, [None], ["a"], "pose", None, [[1, 2], 3]):
        with pytest.raises((TypeError, beeline.Error), match="world_T_tool") as error:
            beeline.inverse_kinematics(PANDA, wrong)
        assert "\n" not in str(error.value)


def test_keywords_of_many_poses():
    q, poses = poses_of(PANDA, 4)
    numbers = beeline.forward_kinematics(PANDA, q, layout="position_quaternion")
    out, reports = np.empty((4, 7)), []
    result = PANDA.inverse_kinematics(poses, seed=q, threads=1, out=out, progress=reports.append)
    assert result.q is out and reports[-1] == 1
    assert np.array_equal(PANDA.inverse_kinematics(numbers, layout="position_quaternion", seed=q).q.shape, (4, 7))
    for one, keywords in ((poses[0], {"threads": 1}), (numbers[0], {"layout": "position_quaternion"})):
        result = PANDA.inverse_kinematics(one, seed=q[0], **keywords)
        assert isinstance(result, beeline.BatchInverseResult) and result.q.shape == (7,) and result
    ended = PANDA.inverse_kinematics(poses, max_work=0)
    assert not ended and ended.ending == "work_limit"


def test_poses_without_a_solution_are_rows_without_numbers():
    _, poses = poses_of(UR5, 3)
    poses[1, :3, 3] = 10
    result = UR5.inverse_kinematics(poses)
    assert not result and result.has_solution.tolist() == [True, False, True] and np.isnan(result.q[1]).all()
