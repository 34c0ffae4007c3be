"""Calls that do not fit a function: one line says which argument is missing, unknown or one too many."""

import inspect
from pathlib import Path

import pytest

import beeline

ARM = beeline.arms.rrr()
CLASSES = {name: value for name in beeline._core.__all__ if inspect.isclass(value := getattr(beeline, name))
           and not issubclass(value, BaseException)}
FUNCTIONS = {name: value for name in beeline._core.__all__
             if callable(value := getattr(beeline, name)) and not inspect.isclass(value)}
STATIC = {f"{name}.{member}": getattr(described, member) for name, described in CLASSES.items()
          for member, value in vars(described).items() if isinstance(value, staticmethod) and not member.startswith("_")}
METHODS = {f"Arm.{name}": getattr(ARM, name) for name in dir(ARM)
           if not name.startswith("_") and callable(getattr(ARM, name))}
CALLED = {**FUNCTIONS, **CLASSES, **STATIC, **METHODS}


class Odd:
    """Of a class that no argument has."""


def refused(function, *arguments, **keywords):
    """The message of a call that is refused; empty if it is accepted."""
    try:
        function(*arguments, **keywords)
    except (TypeError, ValueError, beeline.Error, AttributeError, OSError) as error:
        return str(error)
    return ""


@pytest.mark.parametrize("name", CALLED)
def test_each_message_is_one_line(name):
    function = CALLED[name]
    calls = [refused(function, *[value] * count) for value in (Odd(), None, "?", 1.5) for count in range(6)]
    calls += [refused(function, *[Odd()] * 30), refused(function, no_such_argument=1), refused(function, Odd(), no_such_argument=1)]
    for message in calls:
        assert "\n" not in message and "incompatible function arguments" not in message, message
    assert refused(function, *[Odd()] * 30) and refused(function, no_such_argument=1)


def test_the_argument_is_named():
    for call, message in [
        (lambda: beeline.pose_of(), "pose_of() needs the argument numbers"),
        (lambda: beeline.Pid(), "Pid() needs the argument goal"),
        (lambda: beeline.Trajectory(times=[0, 1], positions=[[0], [1]]), "Trajectory() needs the argument joint_names"),
        (lambda: beeline.move_along(ARM, None), "move_along() needs the argument route"),
        (lambda: ARM.forward_kinematics(), "forward_kinematics() needs the argument q"),
        (lambda: beeline.pose_of([1, 2, 3], tripel="position"), "unknown argument of pose_of() \"tripel\"; did you mean \"triple\"?"),
        (lambda: beeline.pose_of(1, 2, 3, 4), "pose_of() takes at most 3 positional arguments, not 4; give the others by name"),
        (lambda: beeline.chapter_figures(1), "chapter_figures() takes no positional arguments, not 1"),
        (lambda: beeline.chapter_figures(a=1), "chapter_figures() takes no arguments"),
        (lambda: beeline.Program.load("x.csv"), "load() needs the argument arm"),
        (lambda: beeline.Program.load("x.csv", 3), "arm: expected an Arm, not int; beeline.arms.panda() makes one"),
        (lambda: beeline.retime(ARM, 3), "trajectory: expected a Trajectory, not int"),
        (lambda: beeline.Arm("RRR:1,1,1"), "Arm() needs the argument joints; Arm.load('RRR:1,1,1') reads a built-in arm, a joint string or a file"),
        (lambda: beeline.Arm(Path("robot.urdf")), "Arm() needs the argument joints; Arm.load('robot.urdf') reads"),
        (lambda: beeline.Arm(3), "Arm() needs the argument joints; Arm.load(\"panda\") reads"),
        (lambda: beeline.Pose2(1, 2, 3), "Pose2() takes its values by name: x, y, theta"),
        (lambda: beeline.MovingEnds(1, 2, 3), "MovingEnds() takes at most 2 values, start, end, not 3"),
    ]:
        with pytest.raises(TypeError) as error:
            call()
        assert str(error.value).startswith(message), str(error.value)
    assert "unit" not in refused(beeline.pose_of, [1, 2, 3], no=1).replace("angle_unit", "")


@pytest.mark.parametrize("name, place", [
    ("read_arm", "beeline.Arm.load(\"panda\"); also of a joint string \"RRR:1,1,1\" or of a file"),
    ("built_in", "beeline.arms.panda()"), ("read_trajectory", "beeline.Trajectory.load(path)")])
def test_a_function_of_cpp_that_is_elsewhere_names_its_place(name, place):
    with pytest.raises(AttributeError) as error:
        getattr(beeline, name)
    assert f"no attribute '{name}'; in Python it is {place}" in str(error.value)
