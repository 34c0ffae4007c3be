"""Arms, trails, joint curves and reach in matplotlib, which is imported where it is used; headless too.

Every function draws into `ax` where it is given, else into a new figure, and returns the axes: `plot.arm(arm, q)`,
then `ax.figure.savefig("arm.png")`. Planar arms are drawn from above, others in 3D. x is red, y green, z blue;
joint 1 red, joint 2 green, joint 3 blue, as in pictures of `beeline.draw()`. In the place of an arm `arm()`, `motion()` and
`animation()` take a CollisionModel: the arm among its obstacles.
"""

from __future__ import annotations

import importlib
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ._core import Arm, CollisionModel, ReachSlice, Trajectory, display_configuration, distinct_colour, forward_kinematics, motion_limits
from ._core import _arm_of
from ._core import jacobian as _jacobian
from ._matplotlib import AMBER, GREY, LINK, arrow, axes_of, dots, draw_arm, draw_ghost, extent, fit, line, pyplot
from ._matplotlib import skeleton
from ._matplotlib_scene import DrawnScene, closest_configuration

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["animation", "arm", "joints", "motion", "reach", "trail"]


def arm(
    arm: Arm | CollisionModel | str,
    q: ArrayLike | None = None,
    ax: Any = None,
    *,
    frames: bool = False,
    jacobian: bool = False,
    alpha: float = 1.0,
    label: str | None = None,
    shapes: bool = True,
) -> Any:
    """Draws an arm; of a model also its obstacles and the line between the two bodies that are nearest to their clearance.

    Parameters
    ----------
    arm : Arm or CollisionModel or str
        The arm, or the name of a built-in one, or the arm among obstacles.
    q : array_like, default None
        Configuration (n,). Default: `display_configuration(arm)`.
    ax : matplotlib axes, default None
        Plain axes for a planar arm, 3D axes for others. Default: axes of a new figure.
    frames : bool, default False
        Draw the frame of every link; the frame of the tool is always drawn.
    jacobian : bool, default False
        Draw the linear part of the Jacobian's columns as arrows at the tool, scaled to a third of the arm.
    alpha : float, default 1
        Opacity.
    label : str, default None
        In the legend.
    shapes : bool, default True
        Draw the shapes of the links of a model.

    Returns
    -------
    axes
    """
    arm, model = _arm_and_model(arm)
    values = display_configuration(arm) if q is None else np.asarray(q, dtype=float)
    ax = axes_of(arm, ax)
    if model is not None:
        scene = DrawnScene(model, ax, shapes)
        scene.contain_links(values)
        scene.draw_pair(values)
    points = draw_arm(arm, values, ax, frames=frames, alpha=alpha, label=label)
    if jacobian:
        columns = _jacobian(arm, values)[:3].T
        scale = extent(points) / 3 / max(np.linalg.norm(columns, axis=1).max(), 1e-12)
        for k, column in enumerate(columns):
            arrow(arm, ax, points[-1], scale * column, distinct_colour(k), alpha)
    fit(arm, ax)
    return ax


def trail(
    arm: Arm | str,
    motion: Any,
    ax: Any = None,
    *,
    waypoints: ArrayLike | None = None,
    samples: int = 400,
    color: Any = AMBER,
    label: str | None = None,
) -> Any:
    """Draws the path of the tool's origin.

    Parameters
    ----------
    arm : Arm or str
        The arm, or the name of a built-in one.
    motion : Trajectory, a result that has a `trajectory`, or array_like
        A motion, drawn between its samples too; or configurations (N, n).
    ax : matplotlib axes, default None
        As for `arm()`.
    waypoints : array_like, default None
        Poses (N, 4, 4) to mark, numbered from 1.
    samples : int, default 400
        Number of points of a motion, at equal times, besides its samples.
    color, label
        Of the line.

    Returns
    -------
    axes
    """
    arm = _arm_of(arm)
    ax = axes_of(arm, ax)
    positions = forward_kinematics(arm, _configurations(arm, motion, samples))[:, :3, 3]
    line(arm, ax, positions, color=color, linewidth=1.5, label=label, zorder=4)
    if waypoints is not None:
        for number, pose in enumerate(np.asarray(waypoints, dtype=float), 1):
            dots(arm, ax, pose[None, :3, 3], color=color, edgecolor="black", s=18, zorder=5)
            at = pose[: 2 if arm.planar else 3, 3]
            ax.text(*at, f" {number}", color=color, zorder=6)
    fit(arm, ax)
    return ax


def motion(
    arm: Arm | CollisionModel | str,
    motion: Any,
    ax: Any = None,
    *,
    ghosts: int = 3,
    waypoints: ArrayLike | None = None,
    frames: bool = False,
    shapes: bool = True,
) -> Any:
    """Draws a motion: the trail of the tool, the arm at its end and, faded, at `ghosts` earlier times.

    Of a model also the obstacles, the shapes of the links at the end, and at the closest of 201 times the arm, faded, with
    the line between the two bodies that are nearest to their clearance. It takes the parameters of `arm()` and `trail()`.
    Returns the axes.
    """
    arm, model = _arm_and_model(arm)
    configurations = _configurations(arm, motion, 400, only_equal_times=True)
    ax = axes_of(arm, ax)
    if model is not None:
        scene = DrawnScene(model, ax, shapes)
        scene.contain_links(configurations[-1])
        if isinstance(getattr(motion, "trajectory", motion), Trajectory):
            closest = closest_configuration(model, _trajectory(motion).matched_to(arm))
        else:
            closest = configurations[-1]
        draw_ghost(arm, closest, ax)
        scene.draw_pair(closest)
    for k in range(ghosts):
        draw_ghost(arm, configurations[k * (len(configurations) - 1) // ghosts], ax)
    draw_arm(arm, configurations[-1], ax, frames=frames)
    return trail(arm, motion, ax, waypoints=waypoints)


def joints(arm: Any, motion: Any = None, axes: Any = None, *, samples: int = 2000) -> Any:
    """Draws positions, velocities and accelerations of the joints over time.

    Parameters
    ----------
    arm : Arm or str
        The arm, or the name of a built-in one. Its limits are drawn dashed in the joints' colours, where they are near
        the curves; dotted where they are not known and motions assume them. `joints(motion)` draws no limits, `joints(motion, arm)` the same.
    motion : Trajectory, or a result that has a `trajectory`
        The motion, drawn between its samples too.
    axes : three matplotlib axes, default None
        Default: axes of a new figure.
    samples : int, default 2000
        About the number of points of each curve.

    Returns
    -------
    array of three axes
    """
    if not isinstance(arm, (Arm, str)):
        arm, motion = motion, arm
    trajectory = _trajectory(motion)
    if arm is not None:
        arm = _arm_of(arm)
        trajectory = trajectory.matched_to(arm)
    if axes is None:
        _, axes = pyplot().subplots(3, 1, sharex=True, figsize=(7, 7), layout="constrained")
    times, curves = _curves(trajectory, samples)
    known = arm.limits if arm is not None else []
    assumed = [motion_limits(limits) for limits in known]
    kinds = [None, "velocity", "acceleration"]
    names = ["position [rad, m]", "velocity [rad/s, m/s]", "acceleration [rad/s², m/s²]"]
    for ax, curve, name, kind in zip(axes, curves, names, kinds):
        at = times
        if kind == "acceleration" and trajectory.interpolation == "linear" and len(trajectory) > 2:
            at, curve, name = *_differences(trajectory), f"{name}\nby differences"
        for k, joint in enumerate(trajectory.joint_names):
            ax.plot(at, curve[:, k], color=distinct_colour(k), linestyle=_dashes(k), label=joint, linewidth=1.4)
        for k, (limits, used) in enumerate(zip(known, assumed)):
            if kind is None:
                bounds, style = [limits.lower, limits.upper], "--"
            else:
                bounds = [-getattr(used, kind), getattr(used, kind)]
                style = "--" if math.isfinite(getattr(limits, kind)) else ":"
            _limit_lines(ax, bounds, distinct_colour(k), style)
        ax.set_ylabel(name)
        ax.grid(color="0.9")
    axes[-1].set_xlabel("time [s]")
    axes[0].legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False, fontsize="small")
    return axes


def animation(
    arm: Arm | CollisionModel | str,
    motion: Any,
    ax: Any = None,
    *,
    waypoints: ArrayLike | None = None,
    speed: float = 1.0,
    fps: float = 25.0,
    shapes: bool = True,
) -> Any:
    """Draws the arm in motion, leaving the trail of its tool.

    Parameters
    ----------
    arm : Arm or CollisionModel or str
        The arm, or the name of a built-in one, or the arm among obstacles, which stand still.
    motion : Trajectory, or a result that has a `trajectory`
        The motion.
    ax : matplotlib axes, default None
        As for `arm()`.
    waypoints : array_like, default None
        Poses (N, 4, 4) to mark, numbered from 1.
    speed : float, default 1
        Relative to the motion's times.
    fps : float, default 25
        Frames per second.
    shapes : bool, default True
        Draw the shapes of the links of a model.

    Returns
    -------
    matplotlib.animation.FuncAnimation
        Keep it for as long as it plays. `save()` writes it, `to_jshtml()` shows it in a notebook.
    """
    arm, model = _arm_and_model(arm)
    trajectory = _trajectory(motion).matched_to(arm)
    if not (speed > 0 and fps > 0):
        raise ValueError(f"speed and fps are positive numbers, not {speed} and {fps}")
    frames = max(2, math.ceil(trajectory.duration * fps / speed) + 1)
    if frames > 20_000:
        raise ValueError(f"an animation of {frames} frames is too long; play it faster or at fewer fps")
    times = trajectory.times[0] + np.linspace(0, trajectory.duration, frames)
    configurations = trajectory.sample(times).position
    everywhere = np.array([skeleton(arm, q) for q in configurations])
    ax = axes_of(arm, ax)
    scene = None if model is None else DrawnScene(model, ax, shapes)
    line(arm, ax, everywhere.reshape(-1, 3), alpha=0)  # the axes contain the whole motion
    trail(arm, trajectory, ax, waypoints=waypoints, color=(*GREY, 0.35))
    (links,) = line(arm, ax, everywhere[0], color=LINK, linewidth=5, solid_capstyle="round", zorder=2)
    (path,) = line(arm, ax, everywhere[:1, -1], color=AMBER, linewidth=1.5, zorder=4)
    (tool,) = line(arm, ax, everywhere[:1, -1], color=AMBER, marker="o", zorder=5)
    fit(arm, ax)

    def show(frame: int) -> tuple[Any, ...]:
        for shown, points in [
            (links, everywhere[frame]),
            (path, everywhere[: frame + 1, -1]),
            (tool, everywhere[frame, -1:]),
        ]:
            if arm.planar:
                shown.set_data(points[:, 0], points[:, 1])
            else:
                shown.set_data_3d(*points.T)
        if scene is not None:
            scene.show(configurations[frame])
        return links, path, tool

    module = importlib.import_module("matplotlib.animation")
    return module.FuncAnimation(ax.figure, show, frames=frames, interval=1000 / fps, blit=False)


def reach(slice: ReachSlice, ax: Any = None, *, colorbar: bool = True, **options: Any) -> Any:
    """Draws a slice of a reach map: each position that is reached in the colour of its value.

    Parameters
    ----------
    slice : ReachSlice
        Of `slice_of()`.
    ax : matplotlib axes, default None
        Plain axes. Default: axes of a new figure.
    colorbar : bool, default True
        Draw the scale.
    **options
        Of `ax.pcolormesh()`: cmap, vmin, vmax, ....

    Returns
    -------
    axes
    """
    if ax is None:
        ax = pyplot().figure(layout="constrained").add_subplot()
    corners = [axis.lower + axis.step * np.arange(axis.cells + 1) for axis in slice.grid]
    known = {"vmin": 0.0} | ({"vmax": 1.0} if slice.measure == "directions" else {})
    mesh = ax.pcolormesh(*corners, slice.values.T, **known | options)
    if colorbar:
        ax.figure.colorbar(mesh, ax=ax, label=slice.measure)
    ax.set_xlabel(f"{slice.axes[0]} [m]")
    ax.set_ylabel(f"{slice.axes[1]} [m]")
    ax.set_aspect("equal")
    ax.set_title(f"{slice.title}, {slice.normal} = {slice.at:.6g} m")
    return ax


def _arm_and_model(drawn: Arm | CollisionModel | str) -> tuple[Arm, CollisionModel | None]:
    return (drawn.arm, drawn) if isinstance(drawn, CollisionModel) else (_arm_of(drawn), None)


def _dashes(joint: int) -> Any:
    return ["-", (0, (5, 2)), (0, (1.2, 1.6)), (0, (6, 1.6, 1.2, 1.6))][joint // 8 % 4]


def _limit_lines(ax: Any, bounds: list[float], color: Any, style: str) -> None:
    """Lines at limits, of which only those near the curves move the ends of the scale."""
    low, high = ax.get_ylim()
    for bound in bounds:
        if math.isfinite(bound):
            ax.axhline(bound, color=color, linestyle=style, linewidth=0.9, alpha=0.7)
    near = [bound for bound in bounds if low - 0.3 * (high - low) <= bound <= high + 0.3 * (high - low)]
    margin = 0.04 * (high - low)
    ax.set_ylim(min([low, *(bound - margin for bound in near)]), max([high, *(bound + margin for bound in near)]))


def _trajectory(motion: Any) -> Trajectory:
    trajectory = getattr(motion, "trajectory", motion)
    if not isinstance(trajectory, Trajectory):
        raise TypeError(f"motion: expected a Trajectory or a result that has one, not {type(motion).__name__}")
    if len(trajectory) == 0:
        raise ValueError("a motion without samples cannot be drawn")
    return trajectory


def _configurations(arm: Arm, motion: Any, samples: int, only_equal_times: bool = False) -> Array:
    """Configurations along a motion: its samples, and those at equal times; or the rows of an array."""
    if not isinstance(getattr(motion, "trajectory", motion), Trajectory):
        rows = np.atleast_2d(np.asarray(motion, dtype=float))
        return rows
    trajectory = _trajectory(motion).matched_to(arm)
    times = np.linspace(trajectory.times[0], trajectory.times[-1], max(2, samples))
    if not only_equal_times:
        times = np.union1d(times, trajectory.times)
    return trajectory.sample(times).position


def _curves(trajectory: Trajectory, samples: int) -> tuple[Array, list[Array]]:
    """Times and positions, velocities, accelerations there; those on both sides of each sample."""
    knots = trajectory.times
    if len(knots) == 1:
        state = trajectory.sample(knots)
        return knots, [state.position, state.velocity, state.acceleration]
    parts = max(2, samples // (len(knots) - 1))
    times = knots[:-1, None] + np.diff(knots)[:, None] * np.linspace(0, 1, parts)
    times[:, -1] = knots[1:]
    after, before = trajectory.sample(times[:, :-1]), trajectory.sample(times[:, -1:], side="before")
    names = ("position", "velocity", "acceleration")
    columns = [np.concatenate([getattr(after, name), getattr(before, name)], axis=1) for name in names]
    joined = [column.reshape(times.size, -1) for column in columns]
    return times.ravel(), joined


def _differences(trajectory: Trajectory) -> tuple[Array, Array]:
    """Accelerations of a linear motion: differences of the velocities, each between the middles of intervals."""
    times = trajectory.times
    middles = (times[1:] + times[:-1]) / 2
    velocities = np.diff(trajectory.positions, axis=0) / np.diff(times)[:, None]
    values = np.diff(velocities, axis=0) / np.diff(middles)[:, None]
    return np.repeat(middles, 2)[1:-1], np.repeat(values, 2, axis=0)
