"""Arms written as URDF and MJCF, and as DH tables and screws: forward kinematics equal to Pinocchio's and MuJoCo's of the
files, and to textbook products of the tables, at random configurations; of all built-in arms and of every serial chain of
example-robot-data."""

import zlib

import beeline
import mujoco
import numpy as np
import pinocchio
import pytest
from urdf_tree import ROBOTS, UrdfTree

CONFIGURATIONS = 1000
OF_CHAINS = 20  # each of some 400 chains
TOLERANCE = 1e-12  # absolute: metres and radians, on arms of up to about two metres
FILES = [pytest.param(path, id=str(path.relative_to(ROBOTS).with_suffix(""))) for path in sorted(ROBOTS.rglob("*.urdf"))]
ARMS = [about.name for about in beeline.built_in_arms()]
pytestmark = pytest.mark.filterwarnings("ignore::beeline.ModelWarning", "ignore::beeline.InputWarning")


def configurations(arm, count, random):
    lower, upper = np.maximum(arm.lower, -3), np.minimum(arm.upper, 3)
    return random.uniform(lower, np.maximum(lower, upper), (count, arm.dof))


def values(arm, q):
    """The value of every joint: a mimic joint follows its leader."""
    found = dict(zip(arm.joint_names, q))
    for _ in arm.joints:
        for joint in arm.joints:
            if joint.mimic and joint.mimic.leader in found:
                found[joint.name] = joint.mimic.multiplier * found[joint.mimic.leader] + joint.mimic.offset
    return found


def pinocchio_poses(text, arm, tip, all_q):
    model = pinocchio.buildModelFromXML(text)
    data, frame, poses = model.createData(), model.getFrameId(tip), []
    for q in all_q:
        position = pinocchio.neutral(model)
        for name, value in values(arm, q).items():
            joint = model.joints[model.getJointId(name)]
            if joint.nq == 2:  # a continuous joint's cosine and sine
                position[joint.idx_q : joint.idx_q + 2] = np.cos(value), np.sin(value)
            else:
                position[joint.idx_q] = value
        pinocchio.framesForwardKinematics(model, data, position)
        poses.append(data.oMf[frame].homogeneous.copy())
    return np.array(poses)


def mujoco_poses(text, arm, tip, all_q):
    model = mujoco.MjModel.from_xml_string(text)
    data, body, poses = mujoco.MjData(model), model.body(tip).id, []
    for q in all_q:
        for name, value in values(arm, q).items():
            data.qpos[model.joint(name).qposadr[0]] = value
        mujoco.mj_kinematics(model, data)
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = data.xmat[body].reshape(3, 3), data.xpos[body]
        poses.append(pose)
    return np.array(poses)


def last_link(text, tag):
    """The link that is written last, which is the tool: the base of the controller is above."""
    return text.rsplit(f"<{tag} name=", 1)[1].split('"')[1]


def elementary(axis, angle, length):
    pose, (i, j) = np.eye(4), ((axis + 1) % 3, (axis + 2) % 3)
    pose[i, i] = pose[j, j] = np.cos(angle)
    pose[j, i], pose[i, j], pose[axis, 3] = np.sin(angle), -np.sin(angle), length
    return pose


def dh_pose(arm, table, q):
    pose, at = table.base, values(arm, q)
    for joint, row in zip(arm.joints, table.rows):
        slides = row.kind == "prismatic"
        value = at[joint.name]
        about_z = elementary(2, row.theta + (0 if slides else value), row.d + (value if slides else 0))
        about_x = elementary(0, row.alpha, row.a)
        pose = pose @ about_z @ about_x if table.convention == "standard" else pose @ about_x @ about_z
    return pose @ table.tool


def compare(arm, count, random, *, peers):
    """Returns whether the arm has both DH tables."""
    all_q = configurations(arm, count, random)
    expected = beeline.forward_kinematics(arm, all_q)

    def same(found):
        np.testing.assert_allclose(found, expected, rtol=0, atol=TOLERANCE)

    for write, poses, tag in [(arm.to_urdf, pinocchio_poses, "link"), (arm.to_mjcf, mujoco_poses, "body")]:
        try:
            text = write()
        except beeline.Error as error:
            assert "equal position limits" in str(error)
            continue
        tip = last_link(text, tag)
        back = beeline.Arm.from_urdf(text, tip=tip)
        assert back.joint_names == arm.joint_names
        np.testing.assert_array_equal([back.lower, back.upper], [arm.lower, arm.upper])
        if tag == "link":
            np.testing.assert_array_equal([back.velocity, back.acceleration, back.jerk],
                                          [arm.velocity, arm.acceleration, arm.jerk])  # fmt: skip
        same(beeline.forward_kinematics(back, all_q))
        if peers:
            same(poses(text, arm, tip, all_q))
    tables = [arm.dh_table("standard"), arm.dh_table("modified")]
    for table in filter(None, tables):
        same([dh_pose(arm, table, q) for q in all_q])
    return all(tables)


@pytest.mark.parametrize("name", ARMS)
def test_built_in_arms_equal_pinocchio_and_mujoco(name, seed):
    random = np.random.default_rng([seed, zlib.crc32(name.encode())])
    assert compare(beeline.Arm.load(name), CONFIGURATIONS, random, peers=True)


@pytest.mark.parametrize("path", FILES)
def test_chains_come_back(path, seed):
    tree = UrdfTree(path)
    random = np.random.default_rng([seed, zlib.crc32(path.name.encode())])
    read = 0
    for tip in tree.leaves():
        if not tree.moving_joints(tip) or tree.unknown_leaders(tip):
            continue
        try:
            arm = beeline.Arm.load(path, tip=tip)
        except beeline.Error:  # tests/peers/pinocchio_test.py says of which
            continue
        compare(arm, OF_CHAINS, random, peers=read == 0)
        read += 1
