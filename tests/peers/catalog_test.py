"""The built-in arms beside descriptions of ssik and of example-robot-data, by forward kinematics."""

import importlib
import math

import beeline
import numpy as np
import pinocchio
import pytest
from scipy.spatial.transform import Rotation
from urdf_tree import ROBOTS

QUARTER, HALF = math.pi / 2, math.pi
FLANGE_X = {"tool": (0, 0, 0, 0, -QUARTER, 0)}  # x of the other one's flange points forward
URDF_BASE = {"base": (0, 0, 0, 0, 0, HALF)}  # base_link of Universal Robots' URDF files, rotated from the controller's

# name: (module of ssik.prebuilt, frames, tolerance in m and rad). With them, pose = base^-1 * its pose * tool^-1; at our zero its
# joints have the values zeros.
SAME = 1e-9
ARMS = {
    "cr5": ("dobot.cr5", {}, 5e-5),  # right angles of five digits there
    "crx10ia": ("fanuc.crx10ia", {"base": (0, 0, 0.245, 0, 0, 0), "tool": (0, 0, 0, 0, QUARTER, 0)}, SAME),
    "crx10ial": ("fanuc.crx10ial", {"base": (0, 0, 0.245, 0, 0, 0), "tool": (0, 0, 0, HALF, 0, 0)}, SAME),
    "fr3": ("franka.fr3", {}, SAME),
    "gen3": ("kinova.gen3", {}, 6e-4),  # the maker's table rounds to 0.1 mm
    "gen3_lite": ("kinova.gen3_lite", {"tool": (0, 0, -0.13, 0, 0, 0)}, 1e-4),
    "gp8": ("yaskawa.gp8", {"tool": (0, 0, -0.08, 0, -QUARTER, HALF)}, SAME),
    "hc10": ("yaskawa.hc10", {"tool": (0, 0, -0.17, HALF, 0, HALF)}, SAME),
    "iiwa14": ("kuka.iiwa14", {}, SAME),
    "iiwa7": ("kuka.iiwa7", {}, SAME),
    "irb120": ("abb.irb120", FLANGE_X, SAME),
    "irb6700": ("abb.irb6700", FLANGE_X, SAME),
    "jaco2": ("kinova.jaco2", {}, 1e-4),
    "kr210_r2700": ("kuka.kr210_r2700", {"tool": (0, 0, -0.215, HALF, 0, HALF)}, SAME),
    "kr6_r900": ("kuka.kr6_r900", FLANGE_X, SAME),
    "lrmate200id": (
        "fanuc.lrmate200id",
        {"base": (0, 0, 0.33, 0, 0, 0), "tool": (0, 0, 0, 0, -QUARTER, HALF)},
        SAME,
    ),
    "m710ic": ("fanuc.m710ic", {"base": (0, 0, 0.565, 0, 0, 0), "tool": (0, 0, 0, 0, -QUARTER, HALF)}, SAME),
    "m1013": ("doosan.m1013", {}, 2e-3),  # right angles of four digits there
    "nova5": ("dobot.nova5", {}, 5e-5),  # right angles of five digits there
    "openarm_left": ("openarm.left", {"base": (0, -0.031, 0, 0, 0, 0)}, SAME),
    "openarm_right": ("openarm.right", {"base": (0, 0.031, 0, 0, 0, 0)}, SAME),
    "panda": ("franka.panda", {}, SAME),
    "piper": ("agilex.piper", {"zeros": np.radians((0, 2, -2, 0, 0, 0))}, 5e-4),  # older zeros, lengths of the maker's URDF
    "puma560": ("unimation.puma560", {}, SAME),
    "rizon4": ("flexiv.rizon4", {}, 1e-8),
    "rm75": ("realman.rm75", {}, 5e-5),
    "ur3e": ("universal_robots.ur3e", URDF_BASE, 1e-8),
    "ur5": ("universal_robots.ur5", URDF_BASE | {"tool": (0, 0, 0, 0, -QUARTER, QUARTER)}, 1e-8),
    "ur5e": ("universal_robots.ur5e", URDF_BASE, 1e-8),
    "ur7e": ("universal_robots.ur7e", URDF_BASE, 1e-8),
    "ur10e": ("universal_robots.ur10e", URDF_BASE, 1e-8),
    "ur12e": ("universal_robots.ur12e", URDF_BASE, 1e-8),
    "ur15": ("universal_robots.ur15", URDF_BASE, 1e-8),
    "ur16e": ("universal_robots.ur16e", URDF_BASE, 1e-8),
    "ur20": ("universal_robots.ur20", URDF_BASE, 1e-8),
    "ur30": ("universal_robots.ur30", URDF_BASE, 1e-8),
    "widowx250s": ("trossen.widowx250s", {"tool": (-0.093575, 0, 0, 0, 0, 0)}, SAME),
    "xarm6": ("ufactory.xarm6", {}, 5e-5),
    "xarm7": ("ufactory.xarm7", {}, 5e-5),
    "z1": ("unitree.z1", {"tool": (-0.051, 0, 0, 0, 0, 0)}, SAME),
}

SERVOS = ("shoulder_pan", "shoulder_lift", "elbow_flex", "wrist_flex", "wrist_roll")

# name: (file below example-robot-data/robots, link, joints, tolerance in m and rad).
URDF_FILES = {
    "so100": ("so_arm_description/urdf/so100.urdf", "gripper", SERVOS, 5e-5),  # 1.57079 there
    "so101": ("so_arm_description/urdf/so101.urdf", "gripper_frame_link", SERVOS, 5e-5),  # 1.5708 there
    "z1": ("z1_description/urdf/z1.urdf", "gripperStator", [f"joint{k}" for k in range(1, 7)], SAME),
}


def transform(x=0.0, y=0.0, z=0.0, roll=0.0, pitch=0.0, yaw=0.0):
    pose = np.eye(4)
    pose[:3, :3] = Rotation.from_euler("xyz", (roll, pitch, yaw)).as_matrix()
    pose[:3, 3] = x, y, z
    return pose


def rotation(axis, angle):
    """Rodrigues' formula."""
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = np.eye(4)
    matrix[:3, :3] += math.sin(angle) * skew + (1 - math.cos(angle)) * skew @ skew
    return matrix


def tool_of(body, q):
    pose = np.eye(4)
    for joint, value in zip(body.joints, q, strict=True):
        pose = pose @ joint.T_left @ rotation(joint.axis, value) @ joint.T_right
    return pose


@pytest.mark.parametrize("name", ARMS)
def test_arm_equals_another_description(name, seed):
    module, frames, tolerance = ARMS[name]
    body = importlib.import_module(f"ssik.prebuilt.{module}_ik")._KB
    base, tool = (transform(*frames.get(key, ())) for key in ("base", "tool"))
    arm = beeline.Arm.load(name)
    for q in np.random.default_rng(seed).uniform(-np.pi, np.pi, (200, arm.dof)):
        other = np.linalg.inv(base) @ tool_of(body, q + frames.get("zeros", 0)) @ np.linalg.inv(tool)
        np.testing.assert_allclose(beeline.forward_kinematics(arm, q), other, atol=tolerance, rtol=0)


@pytest.mark.parametrize("name", URDF_FILES)
def test_arm_equals_a_urdf_file(name, seed):
    path, link, joints, tolerance = URDF_FILES[name]
    model = pinocchio.buildModelFromUrdf(str(ROBOTS / path))
    data, frame = model.createData(), model.getFrameId(link, pinocchio.FrameType.BODY)
    at = [model.joints[model.getJointId(joint)].idx_q for joint in joints]
    arm = beeline.Arm.load(name)
    for q in np.random.default_rng(seed).uniform(-np.pi, np.pi, (1000, arm.dof)):
        theirs = pinocchio.neutral(model)
        theirs[at] = q
        pinocchio.framesForwardKinematics(model, data, theirs)
        np.testing.assert_allclose(beeline.forward_kinematics(arm, q), data.oMf[frame].homogeneous, atol=tolerance, rtol=0)
