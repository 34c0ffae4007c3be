"""Motion of serial-link robot arms: kinematics, inverse kinematics, lines that are proved straight.

Radians, metres, seconds. Configurations are arrays (n,), or (N, n) for many; poses are 4 x 4 arrays.
An argument `arm` is an Arm, or the name of a built-in one, such as "panda".
Twists and rows of Jacobians have the linear part first: [vx vy vz wx wy wz]. A negative answer is a
result that is false and has a `reason`; invalid input raises `beeline.Error`.
"""

import copyreg as _copyreg
import typing as _typing
from difflib import get_close_matches as _get_close_matches

from . import _core, arms, plot, poses
from ._core import *  # noqa: F403
from ._core import __version__
from ._page import Page, view
from ._pictures import animate, draw, figure
from ._reason import Reason

__all__ = ["Page", "Reason", "__version__", "animate", "arms", "draw", "figure", "plot", "poses", "view"]
__all__ += _core.__all__

for _name in __all__:
    _value = globals()[_name]
    if getattr(_value, "__module__", None) == _core.__name__:
        try:
            _value.__module__ = __name__  # in messages, documentation and pickles
        except (AttributeError, TypeError):
            pass  # a function: it cannot be changed
del _name, _value

# Names of C++, of the command's verbs and of other libraries: what does the same here.
_OTHER_NAMES = {
    "built_in": 'beeline.arms.panda(), or beeline.Arm.load("panda")',
    "built_in_names": "beeline.arms.names()",
    "read_arm": 'beeline.Arm.load("panda"); also of a joint string "RRR:1,1,1" or of a file',
    "arm_from_joint_string": 'beeline.Arm.from_string("RRR:1,1,1")',
    "arm_from_json": "beeline.Arm.from_json(text)",
    "read_urdf": "beeline.Arm.from_urdf(path)",
    "arm_from_urdf": "beeline.Arm.from_urdf(text)",
    "arm_from_dh": "beeline.Arm.from_dh",
    "from_dh": "beeline.Arm.from_dh",
    "arm_from_screws": "beeline.Arm.from_screws",
    "from_screws": "beeline.Arm.from_screws",
    "home_pose": "arm.home",
    "load": "beeline.Arm.load",
    "load_arm": "beeline.Arm.load",
    "write_arm": "arm.save(path)",
    "write_arm_json": "arm.save(path)",
    "arm_file": "arm.to_json(), arm.to_urdf() or arm.to_mjcf()",
    "dh_table": "arm.dh_table(convention)",
    "with_limits": "arm.with_limits",
    "with_mobile_base": "arm.with_mobile_base",
    "with_mount": "arm.with_mount",
    "with_rail": "arm.with_rail",
    "with_tcp": "arm.with_tcp",
    "with_tool": "arm.with_tool",
    "middle_configuration": "arm.middle",
    "read_trajectory": "beeline.Trajectory.load(path)",
    "write_trajectory": "trajectory.save(path)",
    "read_program": "beeline.Program.load(path, arm)",
    "show": "print(arm)",
    "fk": "beeline.forward_kinematics",
    "fkine": "beeline.forward_kinematics",
    "ik": "beeline.inverse_kinematics",
    "ikine": "beeline.inverse_kinematics",
    "jacob0": "beeline.jacobian",
    "inverse_jacobian": "beeline.joint_rates",
    "line": "beeline.move_in_lines",
    "move": "beeline.move_joints",
    "program": "beeline.move_program",
    "check": "beeline.verify",
    "diff": "beeline.difference",
    "doctor": "beeline.compare_arms",
    "export": "beeline.controller_file",
    "batch": "beeline.batch_inverse",
    "formula": "beeline.formula_document",
    "reach": "beeline.reach_map",
}


if not _typing.TYPE_CHECKING:  # a checker would take every name for one that exists

    def __getattr__(name):
        near = _get_close_matches(name, __all__, 1)
        known = _OTHER_NAMES.get(name) or (f"beeline.{near[0]}" if near else None)
        place = f"; in Python it is {known}" if name in _OTHER_NAMES else f"; did you mean {known}?" if known else ""
        raise AttributeError(f"module 'beeline' has no attribute {name!r}{place}", name=name, obj=__import__(__name__))


# Functions pickle by name, as functions of Python do: for multiprocessing, joblib and dask.
_copyreg.pickle(type(_core.forward_kinematics), lambda function: function.__qualname__)
