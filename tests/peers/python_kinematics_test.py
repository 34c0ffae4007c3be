"""The Python module's kinematics equal to Pinocchio's, for every chain in example-robot-data and every built-in
arm, and to Robotics Toolbox's for its Puma 560 and Panda."""

import beeline
import numpy as np
import pinocchio
import pytest
import roboticstoolbox as rtb
from urdf_tree import ROBOTS, UrdfTree

COUNT = 20
TOLERANCE = 1e-10
FRAMES = {
    "base": pinocchio.ReferenceFrame.LOCAL_WORLD_ALIGNED,
    "tool": pinocchio.ReferenceFrame.LOCAL,
    "space": pinocchio.ReferenceFrame.WORLD,
}


class Peer:
    """Pinocchio's kinematics of a chain, in the arm's coordinates."""

    def __init__(self, arm, model, frame):
        self.arm, self.model, self.frame = arm, model, model.getFrameId(frame)
        self.data = model.createData()
        leaders = [joint.name for joint in arm.joints if joint.mimic is None]
        assert leaders == arm.joint_names
        self.drives = {}
        for joint in arm.joints:  # value = ratio * q[coordinate] + shift
            self.drives[joint.name] = (
                (leaders.index(joint.name), 1.0, 0.0)
                if joint.mimic is None
                else self.following(arm, joint, leaders)
            )

    @staticmethod
    def following(arm, joint, leaders):
        ratio, shift = 1.0, 0.0
        by_name = {other.name: other for other in arm.joints}
        while joint.mimic is not None:
            shift += ratio * joint.mimic.offset
            ratio *= joint.mimic.multiplier
            joint = by_name[joint.mimic.leader]
        return leaders.index(joint.name), ratio, shift

    def configuration(self, q):
        values = pinocchio.neutral(self.model)
        for name, (coordinate, ratio, shift) in self.drives.items():
            joint = self.model.joints[self.model.getJointId(name)]
            value = ratio * q[coordinate] + shift
            if joint.nq == 2:  # continuous: a point on the unit circle
                values[joint.idx_q : joint.idx_q + 2] = np.cos(value), np.sin(value)
            else:
                values[joint.idx_q] = value
        return values

    def pose(self, q):
        pinocchio.computeJointJacobians(self.model, self.data, self.configuration(q))
        pinocchio.updateFramePlacements(self.model, self.data)
        return self.data.oMf[self.frame].homogeneous

    def jacobian(self, frame):
        """At the configuration of the last pose()."""
        whole = pinocchio.getFrameJacobian(self.model, self.data, self.frame, FRAMES[frame])
        columns = np.zeros((6, self.arm.dof))
        for name, (coordinate, ratio, _) in self.drives.items():
            columns[:, coordinate] += ratio * whole[:, self.model.joints[self.model.getJointId(name)].idx_v]
        return columns


def check(arm, peer, seed):
    q = np.random.default_rng(seed).uniform(-np.pi, np.pi, (COUNT, arm.dof))
    poses = beeline.forward_kinematics(arm, q)
    jacobians = {frame: beeline.jacobian(arm, q, frame) for frame in FRAMES}
    for i, row in enumerate(q):
        expected = peer.pose(row)
        assert np.abs(poses[i] - expected).max() <= TOLERANCE
        assert np.abs(beeline.forward_kinematics(arm, row) - expected).max() <= TOLERANCE
        for frame, columns in jacobians.items():
            expected = peer.jacobian(frame)
            assert np.abs(columns[i] - expected).max() <= TOLERANCE
            assert np.abs(beeline.jacobian(arm, row, frame) - expected).max() <= TOLERANCE


def chains():
    found = []
    for path in sorted(ROBOTS.rglob("*.urdf")):
        tree = UrdfTree(path)
        for tip in tree.leaves():
            if tree.moving_joints(tip) and not tree.unknown_leaders(tip):
                found.append(pytest.param(path, tree.root, tip, id=f"{path.stem}:{tip}"))
    return found


@pytest.mark.parametrize("path, base, tip", chains())
def test_arms_of_example_robot_data_equal_pinocchio(path, base, tip, seed):
    arm = beeline.Arm.from_urdf(path, base=base, tip=tip)
    model = pinocchio.buildModelFromUrdf(str(path), mimic=False)
    check(arm, Peer(arm, model, tip), seed)


def model_of(arm):
    """Pinocchio's model of an arm, made of its joints: without a file between them."""
    model, parent, place = pinocchio.Model(), 0, pinocchio.SE3(np.array(arm.base))
    for joint in arm.joints:
        linear, angular = joint.screw[:3], joint.screw[3:]
        revolute = np.any(angular)
        point = pinocchio.SE3(np.eye(3), np.cross(angular, linear))
        kind = pinocchio.JointModelRevoluteUnaligned(angular) if revolute else pinocchio.JointModelPrismaticUnaligned(linear)
        parent = model.addJoint(parent, kind, place * pinocchio.SE3(np.array(joint.offset)) * point, joint.name)
        place = point.inverse()
    placement = place * pinocchio.SE3(np.array(arm.tool))
    model.addFrame(pinocchio.Frame("tool", parent, placement, pinocchio.FrameType.OP_FRAME))
    return model


@pytest.mark.parametrize("name", beeline.arms.names())
def test_built_in_arms_equal_pinocchio(name, seed):
    arm = beeline.Arm.load(name)
    check(arm, Peer(arm, model_of(arm), "tool"), seed)


@pytest.mark.parametrize("name", beeline.arms.names())
def test_poses_of_pinocchio_are_taken(name, seed):
    arm = beeline.Arm.load(name)
    q = np.random.default_rng(seed).uniform(np.maximum(arm.lower, -3), np.minimum(arm.upper, 3))
    pose = pinocchio.SE3(np.array(beeline.forward_kinematics(arm, q)))
    assert beeline.inverse_kinematics(arm, pose)
    assert beeline.batch_inverse(arm, [pose, pose])
    assert np.abs(beeline.se3_log(pose) - pinocchio.log6(pose).vector).max() < TOLERANCE
    assert np.abs(beeline.adjoint(pose) - pose.toActionMatrix()).max() < TOLERANCE
    quaternion = beeline.quaternion(pose)
    other = pinocchio.Quaternion(pose.rotation)
    sign = 1 if other.w >= 0 else -1
    difference = np.array([quaternion.qx, quaternion.qy, quaternion.qz, quaternion.qw]) - sign * other.coeffs()
    assert np.abs(difference).max() < TOLERANCE
    angles = beeline.roll_pitch_yaw(pose)
    expected = pinocchio.rpy.matrixToRpy(pose.rotation)
    assert np.abs(beeline.rotation(angles) - pinocchio.rpy.rpyToMatrix(expected)).max() < TOLERANCE


def toolbox_arm(robot):
    """The arm of a Denavit-Hartenberg table of the toolbox."""
    rows = [beeline.DhRow(a=link.a, alpha=link.alpha, d=link.d, theta=link.theta) for link in robot.links]
    convention = "modified" if robot.mdh else "standard"
    table = beeline.Arm.from_dh(rows, convention=convention)
    tool = np.array(table.tool) @ robot.tool.A
    return beeline.Arm(robot.name, table.joints, tool=tool, base=robot.base.A @ np.array(table.base))


@pytest.mark.parametrize("name", ["Puma560", "Panda"])
def test_kinematics_equal_the_toolbox(name, seed):
    robot = getattr(rtb.models.DH, name)()
    arm = toolbox_arm(robot)
    q = np.random.default_rng(seed).uniform(-np.pi, np.pi, (100, arm.dof))
    poses, batch = beeline.forward_kinematics(arm, q), beeline.manipulability(arm, q)
    for i, row in enumerate(q):
        assert np.abs(poses[i] - robot.fkine(row).A).max() <= TOLERANCE
        base, tool = beeline.jacobian(arm, row), beeline.jacobian(arm, row, "tool")
        assert np.abs(base - robot.jacob0(row)).max() <= TOLERANCE
        assert np.abs(tool - robot.jacobe(row)).max() <= TOLERANCE
        expected = robot.manipulability(row)  # with det(), which loses half the digits near zero
        assert batch[i] == pytest.approx(expected, abs=1e-7)
        assert batch[i] ** 2 == pytest.approx(expected**2, abs=TOLERANCE)
        measures = beeline.manipulability_measures(base[:3])
        assert measures.manipulability == pytest.approx(robot.manipulability(row, axes="trans"), abs=TOLERANCE)
        hessian = beeline.hessian(arm, row)
        differences = robot.ets().hessian0(row, robot.ets().jacob0(row)) if not robot.mdh else None
        if differences is not None:
            assert np.abs(hessian - differences).max() <= 1e-9
