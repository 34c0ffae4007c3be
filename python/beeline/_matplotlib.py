"""Arms in axes of matplotlib: what beeline.plot draws its pictures of."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

import numpy as np

from ._core import Arm, Joint, distinct_colour, link_poses

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

LINK = (0.45, 0.52, 0.6)
AMBER = (0.85, 0.37, 0.01)  # trails
GREY = (0.45, 0.47, 0.5)


def pyplot() -> Any:
    try:
        return importlib.import_module("matplotlib.pyplot")
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("beeline.plot needs matplotlib: pip install matplotlib", name=error.name) from None


def axes_of(arm: Arm, ax: Any) -> Any:
    if ax is None:
        figure = pyplot().figure(layout="constrained")
        ax = figure.add_subplot() if arm.planar else figure.add_subplot(projection="3d")
        if not arm.planar:
            ax.set_proj_type("ortho")
            ax.view_init(elev=25, azim=-50)
        if arm.planar:
            ax.grid(color="0.92")
            ax.set_axisbelow(True)
    if (ax.name == "3d") == arm.planar:
        needed = "plain axes: the arm is planar" if arm.planar else 'axes with projection="3d": the arm is spatial'
        raise ValueError(f"{arm.name} needs {needed}")
    return ax


def fit(arm: Arm, ax: Any) -> None:
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    if arm.planar:
        ax.set_aspect("equal", adjustable="datalim")
        return
    ax.set_zlabel("z [m]")
    limits = np.array([axis.get_data_interval() for axis in (ax.xaxis, ax.yaxis, ax.zaxis)])
    limits[2, 0] = min(limits[2, 0], arm.base[2, 3])
    half = 0.55 * max((limits[:, 1] - limits[:, 0]).max(), 1e-6)
    for middle, setter in zip(limits.mean(axis=1), (ax.set_xlim, ax.set_ylim, ax.set_zlim)):
        setter(middle - half, middle + half)
    ax.set_box_aspect((1, 1, 1))
    ax.locator_params(nbins=6)


def _frames(arm: Arm, q: Array) -> Array:
    """The poses of all links and of the tool."""
    links = link_poses(arm, q)
    return np.concatenate([links, (links[-1] @ arm.tool)[None]])


def _axis_points(joint: Joint, before: Array, after: Array) -> Array:
    """The points of a joint's axis that are nearest to the frames of its two links."""
    v, w = after[:3, :3] @ joint.screw[:3], after[:3, :3] @ joint.screw[3:]
    direction = w if w.any() else v
    point = np.cross(w, v) + after[:3, 3] if w.any() else before[:3, 3]  # a prismatic joint has no place
    ends = np.array([before[:3, 3], after[:3, 3]])
    return point + np.outer((ends - point) @ direction, direction)


def skeleton(arm: Arm, q: Array) -> Array:
    """The points that the links are drawn through: three of each joint, those on its axis first; then the tool."""
    poses = _frames(arm, q)
    points = [poses[0, :3, 3]]
    for joint, before, after in zip(arm.joints, poses, poses[1:]):
        points += [*_axis_points(joint, before, after), after[:3, 3]]
    return np.array([*points, poses[-1, :3, 3]])


def draw_arm(
    arm: Arm, q: Array, ax: Any, *, frames: bool = False, alpha: float = 1.0, label: str | None = None
) -> Array:
    """Draws links, joints, base and tool; returns the points of the skeleton."""
    poses, points = _frames(arm, q), skeleton(arm, q)
    line(arm, ax, points, color=LINK, linewidth=5, solid_capstyle="round", alpha=alpha, label=label, zorder=2)
    dots(arm, ax, points[:1], color=GREY, marker="s", s=110, alpha=alpha, zorder=1)
    dots(arm, ax, points[2:-1:3], color="white", edgecolor="black", s=42, alpha=alpha, zorder=3)
    for pose in poses if frames else poses[-1:]:
        _triad(arm, ax, pose, 0.12 * extent(points), alpha)
    return points


def draw_ghost(arm: Arm, q: Array, ax: Any) -> None:
    line(arm, ax, skeleton(arm, q), color=LINK, linewidth=4, solid_capstyle="round", alpha=0.25, zorder=1)


def extent(points: Array) -> float:
    return float(max(np.ptp(points, axis=0).max(), 1e-6))


def line(arm: Arm, ax: Any, points: Array, **style: Any) -> Any:
    return ax.plot(*points.T[: 2 if arm.planar else 3], **style)


def dots(arm: Arm, ax: Any, points: Array, **style: Any) -> Any:
    extra = {} if arm.planar else {"depthshade": False}
    return ax.scatter(*points.T[: 2 if arm.planar else 3], **style, **extra)


def _triad(arm: Arm, ax: Any, pose: Array, size: float, alpha: float) -> None:
    for axis in range(2 if arm.planar else 3):
        arrow(arm, ax, pose[:3, 3], size * pose[:3, axis], distinct_colour(axis), alpha)


def arrow(arm: Arm, ax: Any, at: Array, vector: Array, color: Any, alpha: float) -> None:
    if np.linalg.norm(vector) < 1e-12:
        return
    if arm.planar:
        tip = at + vector
        arrow = {"arrowstyle": "-|>", "color": color, "alpha": alpha, "shrinkA": 0, "shrinkB": 0, "linewidth": 1.6}
        ax.annotate("", tip[:2], at[:2], arrowprops=arrow, zorder=6)
        ax.update_datalim([tip[:2]])
        ax.autoscale_view()
    else:
        ax.quiver(*at, *vector, color=color, alpha=alpha, linewidth=1.6, arrow_length_ratio=0.2, zorder=6)
