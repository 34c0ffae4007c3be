"""TRAC-IK (Beeson and Ames) as pytracik: two solvers race in two threads, here on one core."""

import numpy as np
import pytracik

PACKAGE = "pytracik"
SOLVER = "TRAC-IK"

TIMEOUT = 0.05  # seconds; what is not found by then is not found
EPSILON = 1e-6 / 3**0.5  # it looks at each of three components by itself


def urdf_of(arm):
    """Joints about and along z of frames whose z axes are the arm's."""
    parts = ['<robot name="arm">', '<link name="link0"/>']
    steps = arm.steps()
    for i, step in enumerate(steps, 1):
        kind = "fixed" if i > arm.n else "prismatic" if arm.slides[i - 1] else "revolute"
        limits = "" if i > arm.n else (
            f'<axis xyz="0 0 1"/><limit lower="{float(arm.lower[i - 1])!r}" '
            f'upper="{float(arm.upper[i - 1])!r}" effort="1" velocity="1"/>')
        place = " ".join(repr(float(x)) for x in step[:3, 3])
        turn = " ".join(repr(float(x)) for x in roll_pitch_yaw(step[:3, :3]))
        parts.append(f'<link name="link{i}"/><joint name="joint{i}" type="{kind}">'
                     f'<parent link="link{i - 1}"/><child link="link{i}"/>'
                     f'<origin xyz="{place}" rpy="{turn}"/>{limits}</joint>')
    return "".join([*parts, "</robot>"])


def roll_pitch_yaw(turn):
    pitch = np.arctan2(-turn[2, 0], np.hypot(turn[0, 0], turn[1, 0]))
    if abs(np.cos(pitch)) < 1e-9:
        return np.arctan2(-turn[1, 2], turn[1, 1]), pitch, 0.0
    return np.arctan2(turn[2, 1], turn[2, 2]), pitch, np.arctan2(turn[1, 0], turn[0, 0])


def quaternion(turn):
    """x, y, z, w."""
    w, v = np.linalg.eigh(np.array([
        [turn[0, 0] - turn[1, 1] - turn[2, 2], turn[0, 1] + turn[1, 0], turn[0, 2] + turn[2, 0],
         turn[2, 1] - turn[1, 2]],
        [turn[0, 1] + turn[1, 0], turn[1, 1] - turn[0, 0] - turn[2, 2], turn[1, 2] + turn[2, 1],
         turn[0, 2] - turn[2, 0]],
        [turn[0, 2] + turn[2, 0], turn[1, 2] + turn[2, 1], turn[2, 2] - turn[0, 0] - turn[1, 1],
         turn[1, 0] - turn[0, 1]],
        [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1],
         np.trace(turn)]]))
    return v[:, np.argmax(w)]


def questions(arm):
    """As in peer_eaik.py."""
    if arm.last is not None:
        return {}
    solver = pytracik.TRAC_IK("link0", f"link{arm.n + 1}", urdf_of(arm), TIMEOUT, EPSILON,
                              pytracik.SolveType.Speed)
    if not np.allclose(pytracik.fk(solver, arm.q[0]), arm.poses[0], rtol=0, atol=1e-9):
        raise ValueError(f"TRAC-IK reads another arm than {arm.name} from its URDF")
    goals = [(*map(float, pose[:3, 3]), *map(float, quaternion(pose[:3, :3])))
             for pose in arm.poses]
    near, q = list(arm.near), list(arm.q)

    def read(answer):
        return [(answer[1:], True)] if answer[0] >= 0 else []

    def wrapper(i):
        return pytracik.fk(solver, q[i])

    def from_middle(i):
        return pytracik.ik(solver, arm.middle, *goals[i])

    def from_near(i):
        return pytracik.ik(solver, near[i], *goals[i])

    return {"within limits": (from_middle, read, wrapper),
            "tracking": (from_near, read, wrapper)}
