"""docs/coming_from.md: the names, frames and orders of other libraries beside Beeline's. The page shows these functions."""

from pathlib import Path

import beeline
import ikpy.chain
import numpy as np
import pinocchio
import pytest
import roboticstoolbox
import ssik
from spatialmath import SE3, UnitQuaternion
from urdf_tree import ROBOTS

UR5 = ROBOTS / "ur_description/urdf/ur5_robot.urdf"
PICKER = Path(__file__).resolve().parents[2] / "docs/howto/robot.urdf"
CASES = 20


@pytest.fixture(params=range(CASES))
def random(seed, request):
    print(f"BEELINE_SEED={seed}, case {request.param}")
    return np.random.default_rng([seed, request.param])


def same(one, other, tolerance=1e-10):
    """Equal except for rounding, which is some 1e-15 of metres and radians; a solution beside a singularity magnifies it."""
    return np.shape(one) == np.shape(other) and np.abs(np.subtract(one, other)).max() < tolerance


def test_robotics_toolbox(random):
    robot = roboticstoolbox.models.DH.Puma560()
    pedestal = SE3.Tz(0.67183).A  # 26.45 inches, in the first row of its table
    arm = beeline.arms.puma560().with_mount(pedestal)
    q = random.uniform(-3, 3, 6)

    assert same(robot.fkine(q).A, beeline.forward_kinematics(arm, q))
    assert same(robot.jacob0(q), beeline.jacobian(arm, q))
    assert same(robot.jacobe(q), beeline.jacobian(arm, q, "tool"))
    assert same(robot.manipulability(q), beeline.manipulability(arm, q))


def test_robotics_toolbox_links_and_inverse(random):
    robot = roboticstoolbox.models.DH.Puma560()
    arm = beeline.arms.puma560().with_mount(SE3.Tz(0.67183).A)
    q = random.uniform(-0.7, 0.7, 6)  # within the limits

    links = np.array([pose.A for pose in robot.fkine_all(q)])
    ours = beeline.link_poses(arm, q)
    assert same(links[1:], ours[1:])  # its link 0 is at the floor, ours on the mount
    answer = robot.ikine_LM(robot.fkine(q), q0=q, joint_limits=False, tol=1e-12)  # of half the squared error
    assert answer.success
    assert same(beeline.forward_kinematics(arm, answer.q), robot.fkine(q).A, tolerance=1e-5)
    ours = beeline.inverse_kinematics(arm, robot.fkine(q), seed=q)  # takes the SE3; the solution nearest to the seed
    assert same(ours.solutions[0], q)


def test_modern_robotics(random):
    # Lynch & Park, example 4.5: the space screws [w v] and the home pose of a UR5.
    l1, l2, w1, w2, h1, h2 = 0.425, 0.392, 0.109, 0.082, 0.089, 0.095
    screws = np.array([[0, 0, 1, 0, 0, 0], [0, 1, 0, -h1, 0, 0], [0, 1, 0, -h1, 0, l1],
                       [0, 1, 0, -h1, 0, l1 + l2], [0, 0, -1, -w1, l1 + l2, 0], [0, 1, 0, h2 - h1, 0, l1 + l2]])
    home = np.array([[-1, 0, 0, l1 + l2], [0, 0, 1, w1 + w2], [0, 1, 0, h1 - h2], [0, 0, 0, 1]])
    arm = beeline.Arm.from_screws(screws, home, frame="space", order="wv", name="ur5")  # screws: Slist.T

    tool = arm.forward_kinematics([0, -np.pi / 2, 0, 0, np.pi / 2, 0])
    assert same(tool[:3, 3], [h2, w1, h1 + l1 + l2 + w2])  # as the book says
    linear_first = arm.screws(frame="space", order="vw")  # [v w], as in a Jacobian of Beeline
    assert same(arm.jacobian(np.zeros(6), "space"), linear_first.T)  # JacobianSpace, linear first
    assert same(arm.jacobian(np.zeros(6), "tool"), arm.screws(frame="body", order="vw").T)  # Blist
    q = random.uniform(-1, 1, 6)
    pose = arm.forward_kinematics(q)
    assert same(arm.jacobian(q, "tool"), beeline.adjoint(np.linalg.inv(pose)) @ arm.jacobian(q, "space"))  # JacobianBody


def test_robotics_toolbox_tools(random):
    q = random.uniform(-1, 1, 7)
    hand = SE3.Rz(-np.pi / 4) * SE3.Tz(0.1034)  # on the flange; its DH model has 0.103
    arm = beeline.arms.panda().with_tcp(hand.A)
    assert same(roboticstoolbox.models.Panda().fkine(q).A, beeline.forward_kinematics(arm, q))

    q = random.uniform(-1, 1, 6)
    ours = beeline.forward_kinematics(beeline.arms.ur5(), q)  # its UR5 has d1 = 0.089459, the maker's 0.089159
    assert same(roboticstoolbox.models.DH.UR5().fkine(q).A, SE3.Tz(0.0003).A @ ours)


def test_orientations_of_robotics_toolbox_and_pinocchio(random):
    roll, pitch, yaw = random.uniform(-1, 1, 3)
    rotation = SE3.RPY([roll, pitch, yaw]).R  # order="zyx" is the default, URDF's
    assert same(rotation, pinocchio.rpy.rpyToMatrix(roll, pitch, yaw))

    arm = beeline.arms.panda()
    q = random.uniform(-1, 1, 7)
    pose = beeline.forward_kinematics(arm, q)
    qw, qx, qy, qz = beeline.forward_kinematics(arm, q, layout="position_quaternion")[3:]
    toolbox = UnitQuaternion(pose[:3, :3]).A
    peer = pinocchio.Quaternion(pose[:3, :3]).coeffs()
    assert same(toolbox * np.sign(toolbox[0]), [qw, qx, qy, qz])  # s, v
    assert same(peer * np.sign(peer[3]), [qx, qy, qz, qw])  # x, y, z, w


def test_pinocchio(random):
    model = pinocchio.buildModelFromUrdf(str(UR5))
    data = model.createData()
    tool = model.getFrameId("tool0")
    arm = beeline.Arm.from_urdf(UR5, tip="tool0")
    q = random.uniform(-3, 3, 6)

    pinocchio.forwardKinematics(model, data, q)
    pinocchio.updateFramePlacements(model, data)
    assert same(data.oMf[tool].homogeneous, beeline.forward_kinematics(arm, q))
    for reference, frame in (
        (pinocchio.LOCAL_WORLD_ALIGNED, "base"),
        (pinocchio.LOCAL, "tool"),
        (pinocchio.WORLD, "space"),
    ):
        peer = pinocchio.computeFrameJacobian(model, data, q, tool, reference)
        assert same(peer, beeline.jacobian(arm, q, frame))


def test_pinocchio_continuous_joints(random):
    model = pinocchio.buildModelFromUrdf(str(PICKER))  # lift, shoulder, elbow; turn is continuous
    arm = beeline.Arm.from_urdf(PICKER, tip="gripper")
    q = random.uniform(-3, 3, 4)
    assert model.nq == 5 and arm.dof == 4

    data = model.createData()
    pinocchio.framesForwardKinematics(model, data, np.array([*q[:3], np.cos(q[3]), np.sin(q[3])]))
    peer = data.oMf[model.getFrameId("gripper")].homogeneous
    assert same(peer, beeline.forward_kinematics(arm, q))


def test_ikpy(random):
    chain = ikpy.chain.Chain.from_urdf_file(
        str(PICKER),
        base_elements=["base", "lift", "column", "shoulder", "upper", "elbow", "fore", "turn", "wrist", "gripper_mount"],
        active_links_mask=[False, True, True, True, True, False],
    )
    arm = beeline.Arm.from_urdf(PICKER, tip="gripper")
    q = random.uniform(0, 0.8, 4)

    full = [0, *q, 0]  # the base and the fixed joint have values too
    assert len(chain.links) == len(full)
    pose = beeline.forward_kinematics(arm, q)
    assert same(chain.forward_kinematics(full), pose)
    seed = q + 0.1
    theirs = chain.inverse_kinematics_frame(pose, initial_position=[0, *seed, 0], orientation_mode="all")
    ours = beeline.inverse_kinematics(arm, pose, seed=seed, task="111001")  # x, y, z, rotation about z
    assert same(ours.solutions[0], q)
    assert same(chain.forward_kinematics(theirs), pose, tolerance=1e-5)  # where its search stops


def test_ssik(random):
    robot = ssik.Manipulator.from_prebuilt("ur5_ik")
    arm = beeline.Arm.from_urdf(UR5, tip="ee_link")
    q = random.uniform(-3, 3, 6)

    pose = beeline.forward_kinematics(arm, q)
    assert same(robot.fk(q), pose)
    theirs = robot.solve(pose, max_solutions=1, q_seed=q)  # nearest to the seed
    ours = beeline.inverse_kinematics(arm, pose, seed=q)
    assert same(theirs[0].q, q) and same(ours.solutions[0], q)
