"""Parsers of programs for Universal Robots, ABB and KUKA. Each returns the moves of a file as the controller
takes them, and refuses a statement that it does not know."""

import json
import math
import re

import numpy as np


def translation(x, y, z):
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def about(axis, angle):
    """A rotation about the axis x, y or z."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(4)
    matrix[i, i] = matrix[j, j] = math.cos(angle)
    matrix[i, j], matrix[j, i] = -math.sin(angle), math.sin(angle)
    return matrix


def by_quaternion(w, x, y, z):
    assert abs(math.hypot(w, x, y, z) - 1) < 1e-9
    matrix = np.eye(4)
    matrix[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                      [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                      [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    return matrix


def by_vector(x, y, z):
    angle = math.hypot(x, y, z)
    half = math.sin(angle / 2) / angle if angle > 1e-12 else 0.5
    return by_quaternion(math.cos(angle / 2), half * x, half * y, half * z)


class Moves:
    """What a controller is commanded: `joints` in rad, `poses` of the tool in the root frame in m, in
    the file's order, as (kind, value); and the tool on the flange."""

    def __init__(self):
        self.moves, self.tool, self.work, self.comments = [], None, None, ""

    def joints(self, values):
        assert len(values) == 6
        self.moves.append(("joints", np.array(values)))

    def pose(self, matrix):
        self.moves.append(("pose", matrix))


def split(text):
    """The items of a list, which may hold lists and calls."""
    items, depth = [""], 0
    for c in text:
        depth += (c in "([{") - (c in ")]}")
        if c == "," and depth == 0:
            items.append("")
        else:
            items[-1] += c
    return [item.strip() for item in items]


def ur_pose(text, names):
    if text in names:
        return names[text]
    if text.startswith("pose_trans("):
        frame, pose = split(text.removeprefix("pose_trans(").removesuffix(")"))
        return ur_pose(frame, names) @ ur_pose(pose, names)
    assert text.startswith("p[") and text.endswith("]"), text
    x, y, z, *vector = map(float, text[2:-1].split(","))
    return translation(x, y, z) @ by_vector(*vector)


def read_urscript(text):
    moves, names, depth, first = Moves(), {}, 0, None
    for line in map(str.strip, text.splitlines()):
        call = re.fullmatch(r"(\w+)\((.*)\)", line)
        if line.startswith("#"):
            moves.comments += line + "\n"
        elif line.endswith(":"):
            depth += 1
        elif line == "end":
            depth -= 1
        elif depth > 1:
            continue  # the question before the first move
        elif line.startswith("work = "):
            names["work"] = moves.work = ur_pose(line.removeprefix("work = "), {})
        elif line.startswith("first = "):
            first = json.loads(line.removeprefix("first = "))
        else:
            word, arguments = call[1], split(call[2])
            if word == "set_tcp":
                moves.tool = ur_pose(arguments[0], {})
            elif word in ("movej", "servoj"):
                moves.joints(first if arguments[0] == "first" else json.loads(arguments[0]))
            elif word in ("movel", "movec"):
                assert moves.tool is not None
                for argument in arguments[: 2 if word == "movec" else 1]:
                    moves.pose(ur_pose(argument, names))
            else:
                assert word in ("sleep", "stopj"), line
    assert depth == 0
    return moves


def rapid_pose(value):
    position, orientation = value
    return translation(*(1e-3 * x for x in position)) @ by_quaternion(*orientation)


def rapid_value(text):
    return json.loads(text.replace("9E9", "9e9").replace("TRUE", "true").replace("FALSE", "false"))


def read_rapid(text):
    moves, tools, works, used = Moves(), {"tool0": np.eye(4)}, {"wobj0": np.eye(4)}, set()
    lines = [line.strip() for line in text.splitlines()]
    moves.comments = "\n".join(line for line in lines if line.startswith("!"))
    lines = [line for line in lines if not line.startswith("!")]
    assert lines[0].startswith("MODULE ") and lines[-2:] == ["ENDPROC", "ENDMODULE"]
    routine = next(i for i, line in enumerate(lines) if line.startswith("PROC "))
    for line in lines[1:routine]:
        kind, name, value = re.fullmatch(r"PERS (\w+) (\w+):=(.*);", line).groups()
        assert len(name) <= 32
        value = rapid_value(value)
        if kind == "tooldata":
            held, frame, (mass, *_) = value
            assert held is True and mass > 0
            tools[name] = rapid_pose(frame)
        else:
            assert kind == "wobjdata"
            held, fixed, unit, user, target = value
            assert held is False and fixed is True and unit == ""
            works[name] = moves.work = rapid_pose(user) @ rapid_pose(target)
    for line in lines[routine + 1:-2]:
        word, _, rest = line.removesuffix(";").partition(" ")
        if word in ("ConfJ\\Off", "ConfL\\Off", "WaitTime"):
            continue
        arguments = split(rest)
        count = {"MoveAbsJ": 1, "MoveL": 1, "MoveC": 2}[word]
        tool, _, work = arguments[-1].partition("\\WObj:=")
        used.add(tool)
        for argument in arguments[:count]:
            value = rapid_value(argument.removesuffix("\\NoEOffs"))
            assert value[-1] == [9e9] * 6
            if word == "MoveAbsJ":
                moves.joints(np.radians(value[0]))
            else:
                assert len(value) == 4
                moves.pose(works[work or "wobj0"] @ rapid_pose(value[:2]))
    (name,) = used
    moves.tool = tools[name]
    return moves


def krl_values(text, letters):
    assert text[0] == "{" and text[-1] == "}", text
    items = [item.split() for item in text[1:-1].split(",")]
    assert [item[0] for item in items] == letters, text
    return [float(item[1]) for item in items]


def krl_pose(text):
    x, y, z, a, b, c = krl_values(text, list("XYZABC"))
    a, b, c = np.radians((a, b, c))
    return translation(x / 1e3, y / 1e3, z / 1e3) @ about("z", a) @ about("y", b) @ about("x", c)


def read_krl(text):
    moves, base = Moves(), None
    lines = [line.strip() for line in text.splitlines()]
    moves.comments = "\n".join(line for line in lines if line.startswith(";"))
    lines = [line for line in lines if not line.startswith(";")]
    assert lines[0].startswith("DEF ") and lines[-1] == "END"
    for line in lines[1:-1]:
        word, _, rest = line.partition(" ")
        if line.startswith("$TOOL="):
            moves.tool = krl_pose(line.removeprefix("$TOOL="))
        elif line.startswith("$BASE="):
            root, *frames = line.removeprefix("$BASE=").split(":")
            assert root == "$ROBROOT"
            base = np.eye(4)
            for frame in frames:
                base = moves.work = krl_pose(frame)
        elif word == "PTP":
            axes = krl_values(rest.removesuffix(" C_PTP"), [f"A{i}" for i in range(1, 7)])
            moves.joints(np.radians(axes))
        elif word in ("LIN", "CIRC", "SPL"):
            assert moves.tool is not None
            for frame in split(rest.removesuffix(" C_DIS")):
                moves.pose(base @ krl_pose(frame))
        else:
            assert re.match(r"INT I|BAS\(|FOR |ENDFOR|SPLINE WITH|ENDSPLINE|WAIT SEC|\$(VEL|ACC|APO)", line), line
    return moves


FORMS = {"urscript": ("script", read_urscript), "rapid": ("mod", read_rapid), "krl": ("src", read_krl)}
