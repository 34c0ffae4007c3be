"""IK-Geo (Elias and Wen) in Rust: all solutions; the user must know the arm's family."""

import numpy as np
from description import meeting_point, motion
from ik_geo import Robot

PACKAGE = "ik-geo"
SOLVER = "IK-Geo"

# The family, the joints whose axes meet (from 0, of the chain as it is solved), and whether it is
# solved from the tool to the base: a spherical shoulder is a wrist of the chain turned round.
FAMILIES = {
    "puma560": (Robot.spherical_two_parallel, [(3, 4, 5)], False),
    "ur5": (Robot.three_parallel_two_intersecting, [(4, 5)], False),
    "general_6r": (Robot.gen_six_dof, [], False),
    "panda_q7": (Robot.spherical_two_intersecting, [(0, 1), (3, 4, 5)], True),
    "iiwa14_q7": (Robot.spherical_two_intersecting, [(0, 1), (3, 4, 5)], True),
}


def questions(arm):
    """As in peer_eaik.py."""
    if arm.name not in FAMILIES:
        return {}
    family, meetings, reverse = FAMILIES[arm.name]
    axes, points, home = arm.axes[:6], arm.points[:6].copy(), arm.home
    if arm.last is not None:
        home = motion(arm.axes[6], arm.points[6], False, np.array([arm.last]))[0] @ home
    if reverse:  # base_T_tool^-1 = home^-1 * exp(-S6 q6) ... exp(-S1 q1), seen from the tool
        back = np.linalg.inv(home)
        axes = -(axes[::-1] @ back[:3, :3].T)
        points = points[::-1] @ back[:3, :3].T + back[:3, 3]
        home = back
    for joints in meetings:
        points[list(joints)] = meeting_point(axes[list(joints)], points[list(joints)])
    offsets = np.diff(np.vstack([np.zeros(3), points, home[:3, 3]]), axis=0)
    offsets[np.abs(offsets) < 1e-15] = 0
    robot = family(axes.tolist(), offsets.tolist())

    goals = np.linalg.inv(arm.poses) if reverse else arm.poses
    # It takes a rotation as its columns.
    turns = (goals[:, :3, :3] @ home[:3, :3].T).swapaxes(1, 2).tolist()
    places = goals[:, :3, 3].tolist()
    q = arm.q[:, 5::-1].tolist() if reverse else arm.q[:, :6].tolist()

    def read(answer):
        still = [] if arm.last is None else [arm.last]
        return [(np.array([*(row[::-1] if reverse else row), *still]), not off)
                for row, off in answer]

    return {"all solutions": (lambda i: robot.get_ik(turns[i], places[i]), read,
                              lambda i: robot.forward_kinematics(q[i]))}
