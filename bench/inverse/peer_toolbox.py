"""Robotics Toolbox for Python (Corke and Haviland): ik_LM, its C++ core, Chan's damping."""

import roboticstoolbox as rtb

PACKAGE = "roboticstoolbox-python"
SOLVER = "Robotics Toolbox LM"

RESIDUAL = 0.5 * 1e-6**2  # it compares half the squared error


def ets_of(arm):
    steps = arm.steps()
    parts = []
    for i in range(arm.n):
        joint = rtb.ET.tz if arm.slides[i] else rtb.ET.Rz
        parts += [rtb.ET.SE3(steps[i]), joint(qlim=[arm.lower[i], arm.upper[i]])]
    return rtb.ETS([*parts, rtb.ET.SE3(steps[-1])]).compile()


def questions(arm):
    """As in peer_eaik.py."""
    if arm.last is not None:
        return {}
    ets = ets_of(arm)
    poses, near, q = list(arm.poses), list(arm.near), list(arm.q)

    def read(answer):
        return [(answer.q, bool(answer.success))]

    def wrapper(i):  # it is there at once
        return ets.ik_LM(poses[i], q0=q[i], tol=RESIDUAL, joint_limits=False)

    def within(i):
        return ets.ik_LM(poses[i], tol=RESIDUAL)

    def free(i):
        return ets.ik_LM(poses[i], tol=RESIDUAL, joint_limits=False)

    def track(i):
        return ets.ik_LM(poses[i], q0=near[i], tol=RESIDUAL)

    return {"within limits": (within, read, wrapper),
            "numerical, limits ignored": (free, read, wrapper),
            "tracking": (track, read, wrapper)}
