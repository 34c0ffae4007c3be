"""Forward kinematics of MJCF files equal to MuJoCo's: every named body and site that joints move, at 1,000 random
configurations, of files that have each feature of the format; the limits of their joints, and the places of their geoms."""

from pathlib import Path

import beeline
import mujoco
import numpy as np
import pytest

CONFIGURATIONS = 1000
TOLERANCE = 1e-12  # absolute: metres and radians, on arms of up to about two metres
FILES = sorted((Path(__file__).parent / "mjcf").glob("*.xml"))


class Model:
    """A file in MuJoCo."""

    def __init__(self, path):
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.data = mujoco.MjData(self.model)

    def joints_above(self, body):
        joints = []
        while body:
            first = self.model.body_jntadr[body]
            joints = [*range(first, first + self.model.body_jntnum[body]), *joints]
            body = self.model.body_parentid[body]
        return joints

    def is_arm(self, body):
        types = [self.model.jnt_type[joint] for joint in self.joints_above(body)]
        one_dof = (int(mujoco.mjtJoint.mjJNT_SLIDE), int(mujoco.mjtJoint.mjJNT_HINGE))
        return bool(types) and all(kind in one_dof for kind in types)

    def frames(self):
        """The names of bodies and sites that joints move, with functions of their poses."""
        model, data, found = self.model, self.data, {}
        for i in range(1, model.nbody):
            if model.body(i).name and self.is_arm(i):
                found[model.body(i).name] = lambda i=i: (data.xpos[i], data.xmat[i])
        for i in range(model.nsite):
            if model.site(i).name and self.is_arm(model.site_bodyid[i]):
                found[model.site(i).name] = lambda i=i: (data.site_xpos[i], data.site_xmat[i])
        return found

    def address(self, name):
        for joint in range(self.model.njnt):
            if (self.model.joint(joint).name or f"joint{joint}") == name:
                return self.model.jnt_qposadr[joint]
        raise KeyError(name)

    def place(self, names, q):
        """Moves the named joints, and those that equality constraints couple to them."""
        model, qpos = self.model, self.data.qpos
        qpos[:] = model.qpos0
        for name, value in zip(names, q):
            qpos[self.address(name)] = value
        for _ in range(model.neq):  # a follower may lead another joint
            for e in range(model.neq):
                if model.eq_type[e] != mujoco.mjtEq.mjEQ_JOINT or not model.eq_active0[e]:
                    continue
                follower, leader = model.eq_obj1id[e], model.eq_obj2id[e]
                own = model.jnt_qposadr[follower]
                other = model.jnt_qposadr[leader]
                distance = qpos[other] - model.qpos0[other] if leader >= 0 else 0
                qpos[own] = model.qpos0[own] + np.polyval(model.eq_data[e][4::-1], distance)
        mujoco.mj_kinematics(model, self.data)


def matrix(position, rotation):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation.reshape(3, 3), position
    return pose


def load(path, tip):
    return beeline.Arm.load(path, base="world", tip=tip)


@pytest.mark.filterwarnings("ignore::beeline.ModelWarning")
@pytest.mark.parametrize("path", FILES, ids=[path.stem for path in FILES])
def test_kinematics_equal_mujoco(path, seed):
    random, peer = np.random.default_rng(seed), Model(path)
    frames = peer.frames()
    assert frames
    for tip, pose in frames.items():
        arm = load(path, tip)
        configurations = random.uniform(-3, 3, (CONFIGURATIONS, arm.dof))
        found = beeline.forward_kinematics(arm, configurations)
        expected = np.empty((CONFIGURATIONS, 4, 4))
        for k, q in enumerate(configurations):
            peer.place(arm.joint_names, q)
            expected[k] = matrix(*pose())
        np.testing.assert_allclose(found, expected, rtol=0, atol=TOLERANCE, err_msg=tip)


@pytest.mark.filterwarnings("ignore::beeline.ModelWarning")
@pytest.mark.parametrize("path", FILES, ids=[path.stem for path in FILES])
def test_limits_equal_mujoco(path):
    peer = Model(path)
    for tip in peer.frames():
        for joint in load(path, tip).joints:
            index = list(peer.model.jnt_qposadr).index(peer.address(joint.name))
            lower, upper = peer.model.jnt_range[index]
            if not peer.model.jnt_limited[index]:
                lower, upper = -np.inf, np.inf
            assert joint.limits.lower == pytest.approx(lower, abs=1e-15)
            assert joint.limits.upper == pytest.approx(upper, abs=1e-15)
