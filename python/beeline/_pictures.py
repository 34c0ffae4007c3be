"""Pictures as the verbs `draw` and `figure` of the command line make them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._core import (
    Animation,
    Arm,
    CollisionModel,
    Picture,
    Trajectory,
    arm_figure,
    chapter_figure,
    motion_animation,
    motion_figure,
)

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def draw(arm: Arm | CollisionModel | str, shown: Any = None, *, waypoints: ArrayLike | None = None, **options: Any) -> Picture:
    """Draws an arm, or its motion.

    Parameters
    ----------
    arm : Arm or CollisionModel or str
        The arm, or the name of a built-in one, or the arm among obstacles.
    shown : array_like, Trajectory, or a result that has a `trajectory`, default None
        A configuration (n,), or a motion. Default: `display_configuration(arm)`.
    waypoints : array_like, default None
        Poses (N, 4, 4) to mark in the picture of a motion, numbered from 1.
    **options
        Options of `arm_figure()`: frames, jacobian, title, caption, azimuth, elevation, ....

    Returns
    -------
    Picture
        Notebooks show it, `save()` writes it.

    Raises
    ------
    beeline.Error
        As arm_figure() and motion_figure() do.
    """
    shown = getattr(shown, "trajectory", shown)
    if isinstance(shown, Trajectory):
        return motion_figure(arm, shown, waypoints, **options)
    if waypoints is not None:
        raise TypeError("waypoints are marked in the picture of a motion: draw(arm, trajectory, waypoints=...)")
    return arm_figure(arm, shown, **options)


def animate(
    arm: Arm | CollisionModel | str, motion: Any, *, waypoints: ArrayLike | None = None, small_views: bool = False, **options: Any
) -> Animation:
    """Draws the motion of an arm as an animation.

    Parameters
    ----------
    arm : Arm or CollisionModel or str
        The arm, or the name of a built-in one, or the arm among obstacles.
    motion : Trajectory, or a result that has a `trajectory`
        The motion.
    waypoints : array_like, default None
        Poses (N, 4, 4) to mark, numbered from 1.
    small_views : bool, default False
        Add small views from above and from the front (spatial arms).
    **options
        Options of `motion_animation()`: speed, rest_before, rest_after, frames, azimuth, ....

    Returns
    -------
    Animation
        Notebooks play it, `save()` writes it.

    Raises
    ------
    beeline.Error
        As motion_animation() does.
    """
    trajectory = getattr(motion, "trajectory", motion)
    return motion_animation(arm, trajectory, waypoints, small_views=small_views, **options)


def figure(number: str) -> Picture:
    """Draws a figure of Dellaert, *Serial Link Manipulators*: one of `chapter_figures()`."""
    return chapter_figure(number)
