"""Motion of serial-link robot arms: kinematics, inverse kinematics, lines that are proved straight.

Radians, metres, seconds. Configurations are arrays (n,), or (N, n) for many; poses are 4 x 4 arrays.
Twists and rows of Jacobians have the linear part first: [vx vy vz wx wy wz]. A negative answer is a
result that is false and has a `reason`; invalid input raises `beeline.Error`.
"""

import copyreg as _copyreg

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

# Functions pickle by name, as functions of Python do: for multiprocessing, joblib and dask.
_copyreg.pickle(type(_core.forward_kinematics), lambda function: function.__qualname__)
