"""A strict reader of trajectory_msgs/msg/JointTrajectory: the definitions as published, no member more
or less, and numbers of the declared types. It shares no code with the library."""

import json
import re

DEFINITIONS = {  # of ROS 2 Humble
    "JointTrajectory": "Header header, string[] joint_names, JointTrajectoryPoint[] points",
    "JointTrajectoryPoint": "float64[] positions, float64[] velocities, float64[] accelerations, "
                            "float64[] effort, Duration time_from_start",
    "Header": "Time stamp, string frame_id",
    "Time": "int32 sec, uint32 nanosec",
    "Duration": "int32 sec, uint32 nanosec",
}
INTEGERS = {"int32": (-2**31, 2**31 - 1), "uint32": (0, 2**32 - 1)}
# What YAML 1.1, the language of `ros2 topic pub`, takes for a real number: 1e-07 would be text.
YAML_FLOAT = re.compile(r"[-+]?[0-9][0-9_]*\.[0-9_]*([eE][-+][0-9]+)?")


class YamlFloat(float):
    pass


def check(value, kind, place):
    if kind.endswith("[]"):
        assert isinstance(value, list), place
        for i, item in enumerate(value):
            check(item, kind[:-2], f"{place}[{i}]")
    elif kind in DEFINITIONS:
        members = dict(reversed(member.split()) for member in DEFINITIONS[kind].split(", "))
        assert list(value) == list(members), (place, list(value))
        for name, member_kind in members.items():
            check(value[name], member_kind, f"{place}.{name}")
    elif kind in INTEGERS:
        low, high = INTEGERS[kind]
        assert type(value) is int and low <= value <= high, (place, value)
    elif kind == "float64":
        assert isinstance(value, YamlFloat), (place, value)
    else:
        assert kind == "string" and isinstance(value, str), (place, value)


def real(text):
    assert YAML_FLOAT.fullmatch(text), text
    return YamlFloat(text)


def read(text):
    """The message as a dictionary; the lines that begin with # are comments of YAML."""
    lines = text.splitlines()
    comments = [line for line in lines if line.startswith("#")]
    message = json.loads("\n".join(lines[len(comments):]), parse_float=real)
    check(message, "JointTrajectory", "message")
    joints = len(message["joint_names"])
    times = []
    for point in message["points"]:
        for column in ("positions", "velocities", "accelerations", "effort"):
            assert len(point[column]) in ((joints,) if column == "positions" else (0, joints))
        duration = point["time_from_start"]
        assert duration["nanosec"] < 10**9
        times.append(duration["sec"] * 10**9 + duration["nanosec"])
    assert times == sorted(set(times)), "times increase"
    return message, times, comments
