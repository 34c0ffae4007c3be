"""EAIK (Ostermeier): finds the family of a 6R arm by itself and gives all solutions."""

import numpy as np
from eaik.pybindings import EAIK

PACKAGE = "eaik"
SOLVER = "EAIK"


def robot_of(arm):
    offsets = np.diff(np.vstack([np.zeros(3), arm.points, arm.home[:3, 3]]), axis=0)
    still = [] if arm.last is None else [(arm.n - 1, arm.last)]
    return EAIK.Robot(arm.axes.T, offsets.T, arm.home[:3, :3], still, True)


def questions(arm):
    """case -> (ask, read, wrapper). ask(i) is what is timed; read turns its answer into a list of
    (configuration, whether the peer claims that it is a solution); wrapper(i) does almost nothing
    beside handing its arguments over: forward kinematics."""
    if any(arm.slides) or arm.n - (arm.last is not None) != 6:
        return {}
    robot = robot_of(arm)
    if not robot.has_known_decomposition():
        return {}
    poses = list(arm.poses)
    q = list(arm.q)

    def read(answer):
        short = arm.last is not None and len(answer.Q) and len(answer.Q[0]) < arm.n
        return [(np.append(row, arm.last) if short else row, not off)
                for row, off in zip(answer.Q, answer.is_LS)]

    return {"all solutions": (lambda i: robot.calculate_IK(poses[i]), read,
                              lambda i: robot.fwdkin(q[i]))}
