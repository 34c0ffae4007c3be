"""Other packages' calls for one arm: name of the package -> {what: (expression in q, T; names in it)}.

q is a configuration, T the tool's pose: of the peer's own arm if it brings one along, then `forward` gives T."""

import importlib
import sys
import tempfile
from pathlib import Path

import beeline
import numpy as np

sys.path.append(str(Path(__file__).parents[1] / "inverse"))
from description import meeting_point  # noqa: E402  (found by the line above)

SSIK = {"ur5": "ur5_ik", "panda": "franka_panda_ik", "crx10ia": "fanuc.crx10ia_ik", "gen3": "kinova.gen3_ik",
        "rizon4": "flexiv.rizon4_ik"}


def arm_of(name):
    """The built-in arm, or that which ssik has by this name."""
    if name in {arm.name for arm in beeline.built_in_arms()}:
        return beeline.Arm.load(name)
    joints, after = [], np.eye(4)
    for joint in importlib.import_module("ssik.prebuilt." + SSIK[name])._KB.joints:
        lower, upper = joint.limits
        joints.append(beeline.Joint(name=joint.name, offset=after @ joint.T_left,
                                    screw=[0, 0, 0, *joint.axis], limits=beeline.Limits(lower=lower, upper=upper)))
        after = joint.T_right
    return beeline.Arm(name, joints, tool=after)


def urdf_of(arm):
    """The arm's chain as URDF: from frame to frame by its joints' offsets and screws."""
    parts, before = ['<robot name="arm"><link name="link0"/>'], arm.base
    names = [f"link{i}" for i in range(len(arm.joints) + 1)] + ["tool"]
    for i, joint in enumerate(arm.joints):
        linear, angular = joint.screw[:3], joint.screw[3:]
        point = np.eye(4)
        point[:3, 3] = np.cross(angular, linear)
        kind, axis = ("revolute", angular) if angular.any() else ("prismatic", linear)
        limit = f'<limit lower="{float(arm.lower[i])!r}" upper="{float(arm.upper[i])!r}" effort="1" velocity="1"/>'
        if np.isinf(arm.lower[i]):
            kind, limit = "continuous", ""
        parts.append(element(names, i, kind, before @ joint.offset @ point, axis, limit))
        before = np.linalg.inv(point)
    parts.append(element(names, len(arm.joints), "fixed", before @ arm.tool, np.zeros(3), ""))
    return "".join([*parts, "</robot>"])


def numbers(values):
    return " ".join(repr(float(value)) for value in values)


def element(names, i, kind, place, axis, limit):
    turn = beeline.roll_pitch_yaw(place)
    axis_text = f'<axis xyz="{numbers(axis)}"/>' if kind != "fixed" else ""
    return (f'<link name="{names[i + 1]}"/><joint name="joint{i + 1}" type="{kind}">'
            f'<parent link="{names[i]}"/><child link="{names[i + 1]}"/>'
            f'<origin xyz="{numbers(place[:3, 3])}" rpy="{turn.roll!r} {turn.pitch!r} {turn.yaw!r}"/>'
            f"{axis_text}{limit}</joint>")


def pin(arm, urdf):
    import pinocchio

    model = pinocchio.buildModelFromXML(urdf)
    names = {"pin": pinocchio, "model": model, "data": model.createData(), "tool": model.getFrameId("tool"),
             "world": pinocchio.LOCAL_WORLD_ALIGNED}
    forward = "(pin.forwardKinematics(model, data, q), pin.updateFramePlacement(model, data, tool).homogeneous)[1]"
    return names, {"forward": forward, "jacobian": "pin.computeFrameJacobian(model, data, q, tool, world)"}


def roboticstoolbox(arm, urdf):
    import roboticstoolbox as rtb

    parts = [rtb.ET.SE3(arm.base)]
    for i, joint in enumerate(arm.joints):
        parts += [rtb.ET.SE3(joint.offset), rtb.ET.Rz(qlim=[arm.lower[i], arm.upper[i]])]
    ets = rtb.ETS([*parts, rtb.ET.SE3(arm.tool)]).compile()
    return {"ets": ets}, {"forward": "ets.eval(q)", "jacobian": "ets.jacob0(q)",
                          "inverse": "ets.ik_LM(T, tol=0.5e-12)[0]"}


def ikpy(arm, urdf):
    from ikpy.chain import Chain

    with tempfile.NamedTemporaryFile("w", suffix=".urdf") as file:
        file.write(urdf)
        file.flush()
        mask = [False] + [True] * arm.dof + [False]
        chain = Chain.from_urdf_file(file.name, base_elements=["link0"], active_links_mask=mask)
    forward = "chain.forward_kinematics([0, *q, 0])"
    return {"chain": chain}, {"forward": forward,
                              "inverse": "chain.inverse_kinematics_frame(T, orientation_mode='all')[1:-1]"}


def pytracik(arm, urdf):
    import pytracik as tracik

    solver = tracik.TRAC_IK("link0", "tool", urdf, 0.05, 1e-6 / 3**0.5, tracik.SolveType.Speed)
    quaternion = beeline.quaternion
    names = {"tracik": tracik, "solver": solver, "middle": arm.middle,
             "goal": lambda T: (*T[:3, 3].tolist(), *(lambda p: (p.qx, p.qy, p.qz, p.qw))(quaternion(T)))}
    return names, {"forward": "tracik.fk(solver, q)", "inverse": "tracik.ik(solver, middle, *G)[1:]",
                   "prepare": "goal(T)"}


def axes_of(arm):
    """The axes of the joints, a point on each, and the pose of the tool, in the world at q = 0."""
    link, axes, points = arm.base, [], []
    for joint in arm.joints:
        link = link @ joint.offset
        axes.append(link[:3, :3] @ joint.screw[3:])
        points.append(link[:3, 3] + link[:3, :3] @ np.cross(joint.screw[3:], joint.screw[:3]))
    return np.array(axes), np.array(points), link @ arm.tool


def eaik(arm, urdf):
    """All solutions, limits ignored."""
    from eaik.pybindings import EAIK

    if arm.dof != 6:
        raise ValueError("EAIK has six joints")
    axes, points, home = axes_of(arm)
    offsets = np.diff(np.vstack([np.zeros(3), points, home[:3, 3]]), axis=0)
    robot = EAIK.Robot(axes.T, offsets.T, home[:3, :3], [], True)
    return {"robot": robot}, {"forward": "robot.fwdkin(q)", "all": "robot.calculate_IK(T).Q"}


def ik_geo(arm, urdf):
    """All solutions, limits ignored, of the family that its user names."""
    from ik_geo import Robot

    if arm.name != "ur5":
        raise ValueError("its user must know the family; its search for general arms takes seconds a pose")
    axes, points, home = axes_of(arm)
    points[[4, 5]] = meeting_point(axes[[4, 5]], points[[4, 5]])
    offsets = np.diff(np.vstack([np.zeros(3), points, home[:3, 3]]), axis=0)
    offsets[np.abs(offsets) < 1e-15] = 0
    robot = Robot.three_parallel_two_intersecting(axes.tolist(), offsets.tolist())
    names = {"robot": robot, "goal": lambda T: ((T[:3, :3] @ home[:3, :3].T).T.tolist(), T[:3, 3].tolist())}
    return names, {"all": "robot.get_ik(*G)", "prepare": "goal(T)"}


def ssik(arm, urdf):
    """Its own arms of these names: one solution within limits; of six joints all solutions too."""
    names = {"arm": importlib.import_module("ssik.prebuilt." + SSIK[arm.name])}
    calls = {"forward": "arm.fk(q)", "inverse": "next((found.q for found in arm.solve(T, max_solutions=1)), None)"}
    return names, calls | ({"all": "arm.solve(T)"} if arm.dof == 6 else {})


def frankik(arm, urdf):
    """Its own arm with its hand. One solution, the last joint sampled."""
    if arm.name != "panda":
        raise ValueError("it has Franka arms only")
    from frankik import FrankaKinematics, RobotType

    names = {"arm": FrankaKinematics(robot_type=RobotType.PANDA), "hand": FrankaKinematics.FrankaHandTCPOffset}
    return names, {"forward": "arm.forward(q, hand)", "inverse": "arm.inverse(T, tcp_offset=hand)"}


PEERS = {"pin": pin, "roboticstoolbox": roboticstoolbox, "ikpy": ikpy, "pytracik": pytracik,
         "eaik": eaik, "ik_geo": ik_geo, "ssik": ssik, "frankik": frankik}
