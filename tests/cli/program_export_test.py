"""export of programs: the moves in the makers' languages, read by independent parsers."""

import json
import math
import re

import numpy as np
import pytest

import urscript

HEAD = "motion,relative,x,y,z,roll,pitch,yaw,q,speed,blend,dwell\n"
PROGRAM = HEAD + """joint,next,0,0,-0.1,0,0,0,,,,
line,,-0.4,-0.3,0.2,2.9,0.1,0.4,,0.1,,0.5
line,previous,0,0.02,-0.1,0,0,0.1,,0.25,0.01,
line,previous,0.1,0,-0.1,0.1,0,0,,,,
via,previous,0.05,0.01,-0.1,0,0,0,,,,
arc,previous,0.1,0,-0.1,0,0.1,0,,0.3,,0.25
joint,,,,,,,,"0,-1.5,1.5,0,0.5,0",,,
"""
SPLINES = """joint,,-0.4,-0.3,0.3,2.9,0,0,,,,
spline,,-0.4,-0.25,0.3,2.9,0,0,,0.2,,
spline,,-0.4,-0.2,0.35,2.9,0,0,,0.1,,0.5
"""
START = ("--from", "0,-1.5,1.5,0,0.5,0")
MOUNT = ("--mount", "0.3,0.2,0.1,0,0,0.7", "--tcp", "0.01,0,0.1,0.2,0,0")


def rotation(axis, angle):
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * k + (1 - math.cos(angle)) * k @ k


def pose(position, matrix):
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = matrix, position
    return result


def rpy(x, y, z, roll, pitch, yaw):
    return pose((x, y, z), rotation((0, 0, 1), yaw) @ rotation((0, 1, 0), pitch) @ rotation((1, 0, 0), roll))


def waypoints(mount):
    """The program's waypoints as the file says them, in the arm's base: (motion, pose or joints)."""
    base = np.linalg.inv(mount)
    grip = rpy(-0.4, -0.3, 0.2, 2.9, 0.1, 0.4)
    back = grip @ rpy(0, 0.02, -0.1, 0, 0, 0.1)
    aside = back @ rpy(0.1, 0, -0.1, 0.1, 0, 0)
    via, arc = aside @ rpy(0.05, 0.01, -0.1, 0, 0, 0), aside @ rpy(0.1, 0, -0.1, 0, 0.1, 0)
    return {"above": base @ grip @ rpy(0, 0, -0.1, 0, 0, 0), "grip": base @ grip, "back": base @ back,
            "aside": base @ aside, "via": base @ via, "arc": base @ arc}


@pytest.fixture(params=[(), MOUNT], ids=["plain", "mounted"])
def cell(request):
    mount = rpy(0.3, 0.2, 0.1, 0, 0, 0.7) if request.param else np.eye(4)
    return request.param, waypoints(mount)


@pytest.fixture
def exported(beeline, written, tmp_path):
    def run(form, out, *options, program=PROGRAM):
        written("cell.csv", program)
        command = ("export", "ur5e", "cell.csv", *START, "--as", form, "--out", out, *options)
        answer = beeline(*command)
        assert answer.code == 0 and answer.out == "", answer.err
        text = (tmp_path / out).read_text()
        report = beeline(*command, "--json").json
        assert report["moves"] == program.count("\n") - 2 and "order and the waypoints" in report["proof"]
        assert report["proof"] in answer.err and report["note"] in answer.err
        head = "\n".join(text.splitlines()[:5])
        assert report["proof"] in head and report["note"] in head
        return text

    return run


@pytest.fixture
def tool_at(beeline):
    def fk(q, options):
        m = beeline("fk", "ur5e", "--q", ",".join(map(repr, q)), *options, "--json").json["pose"]["matrix"]
        mount = rpy(0.3, 0.2, 0.1, 0, 0, 0.7) if options else np.eye(4)
        return np.linalg.inv(mount) @ np.array(m)

    return fk


def close(found, expected, tolerance=1e-9):
    assert np.abs(found - expected).max() <= tolerance, (found, expected)


def test_a_ur_program_has_the_waypoints(cell, exported, tool_at):
    options, expected = cell
    comments, calls, values = urscript.read(exported("urscript", "p.script", *options))
    assert urscript.numbers(values["first"]) == pytest.approx([0, -1.5, 1.5, 0, 0.5, 0], abs=1e-9)

    def read(text):
        v = urscript.numbers(text)
        assert text.startswith("p[")
        return pose(v[:3], rotation(v[3:], np.linalg.norm(v[3:])))

    calls = calls[next(i for i, call in enumerate(calls) if call[0] == "movej") + 1:]
    assert [name for name, _ in calls] == ["movej", "movel", "sleep", "movel", "movel", "movec", "sleep",
                                           "movej"]
    (_, above), (_, grip), (_, rest), (_, back), (_, aside), (_, arc), (_, pause), (_, home) = calls
    close(tool_at(urscript.numbers(above[0]), options), expected["above"], 1e-8)
    for call, name in ((grip, "grip"), (back, "back"), (aside, "aside")):
        close(read(call[0]), expected[name])
    close(read(arc[0])[:3, 3], expected["via"][:3, 3])
    close(read(arc[1]), expected["arc"])
    assert urscript.numbers(home[0]) == pytest.approx([0, -1.5, 1.5, 0, 0.5, 0], abs=1e-9)
    assert [float(call["v"]) for call in (grip, back, arc)] == [0.1, 0.25, 0.3]
    assert [float(call["r"]) > 0 for call in (grip, back, aside, arc)] == [False, True, False, False]
    assert (float(rest[0]), float(pause[0])) == (0.5, 0.25)
    assert all(float(call["a"]) > 0 for call in (above, grip, back, aside, arc, home))


def quaternion(qw, qx, qy, qz):
    angle = 2 * math.atan2(math.hypot(qx, qy, qz), qw)
    return rotation((qx, qy, qz), angle)


def test_a_rapid_module_has_the_waypoints(cell, exported, tool_at):
    options, expected = cell
    text = exported("rapid", "cell_abb.mod", *options)
    lines = [line.strip() for line in text.splitlines() if not line.strip().startswith("!")]
    assert lines.pop(1).startswith("PERS tooldata tool_cell_abb:=") if options else True
    assert lines[:2] == ["MODULE cell_abb", "PROC play_cell_abb()"]
    assert lines[2:4] == ["ConfJ\\Off;", "ConfL\\Off;"] and lines[-2:] == ["ENDPROC", "ENDMODULE"]

    def arguments(line):
        word, _, rest = line.rstrip(";").partition(" ")
        found, depth = [""], 0
        for c in rest:
            depth += (c == "[") - (c == "]")
            if c == "," and depth == 0:
                found.append("")
            else:
                found[-1] += c
        return word, [json.loads(re.sub("9E9", "9e9", item)) if item.startswith("[[") else item
                      for item in (part.replace("\\NoEOffs", "") for part in found)]

    def target(value):
        position, orientation, _, external = value
        assert len(external) == 6
        return pose(np.array(position) / 1e3, quaternion(*orientation))

    calls = [arguments(line) for line in lines[4:-2]]
    assert [word for word, _ in calls] == ["MoveAbsJ", "MoveAbsJ", "MoveL", "WaitTime", "MoveL", "MoveL",
                                           "MoveC", "WaitTime", "MoveAbsJ"]
    (_, start), (_, above), (_, grip), (_, rest), (_, back), (_, aside), (_, arc), (_, pause), _ = calls
    assert start[0][0] == pytest.approx(np.degrees([0, -1.5, 1.5, 0, 0.5, 0]).tolist(), abs=1e-6)
    close(tool_at(np.radians(above[0][0]).tolist(), options), expected["above"], 1e-7)
    for call, name in ((grip, "grip"), (back, "back"), (aside, "aside")):
        close(target(call[0]), expected[name])
    close(target(arc[0])[:3, 3], expected["via"][:3, 3])
    close(target(arc[1]), expected["arc"])
    speed = lambda item: json.loads(item)[0]
    assert [speed(grip[1]), speed(back[1]), speed(arc[2])] == [100, 250, 300]
    assert grip[2] == aside[2] == arc[3] == "fine" and back[2].startswith("[FALSE,")
    assert (float(rest[0]), float(pause[0])) == (0.5, 0.25)


def krl_frame(text):
    values = [float(re.fullmatch(rf"{axis} (\S+)", item)[1]) for axis, item in zip("XYZABC", text.split(","))]
    a, b, c = np.radians(values[3:])
    turn = rotation((0, 0, 1), a) @ rotation((0, 1, 0), b) @ rotation((1, 0, 0), c)
    return pose(np.array(values[:3]) / 1e3, turn)


def test_a_krl_program_has_the_waypoints(cell, exported, tool_at):
    options, expected = cell
    text = exported("krl", "cell_kuka.src", *options, program=PROGRAM + SPLINES)
    lines = [line.strip() for line in text.splitlines() if not line.startswith(";")]
    assert lines[0] == "DEF cell_kuka()" and lines[-1] == "END" and "$BASE=$ROBROOT" in lines
    moves = [line for line in lines if re.match("PTP|LIN|CIRC|WAIT|SPL|ENDSPLINE", line)]
    assert [move.split()[0] for move in moves] == ["PTP", "PTP", "LIN", "WAIT", "LIN", "LIN", "CIRC", "WAIT",
                                                   "PTP", "PTP", "SPLINE", "SPL", "SPL", "ENDSPLINE", "WAIT"]
    frames = [[krl_frame(frame) for frame in re.findall(r"\{(X[^}]*)\}", move)] for move in moves]
    axes = [float(item.split()[1]) for item in re.search(r"\{(A1.*)\}", moves[1])[1].split(",")]
    close(tool_at(np.radians(axes).tolist(), options), expected["above"], 1e-7)
    for i, name in ((2, "grip"), (4, "back"), (5, "aside")):
        close(frames[i][0], expected[name])
    close(frames[6][0][:3, 3], expected["via"][:3, 3])
    close(frames[6][1], expected["arc"])
    assert [move.endswith("C_DIS") for move in moves] == [i == 4 for i in range(len(moves))]
    speeds = [float(line.split("=")[1]) for line in lines if line.startswith("$VEL.CP=")]
    assert (speeds[0], speeds[1], speeds[3]) == (0.1, 0.25, 0.3)
    assert moves[10] == "SPLINE WITH $VEL.CP=0.100000000"  # the lowest of its speeds
    assert [float(moves[i].split()[-1]) for i in (3, 7, 14)] == [0.5, 0.25, 0.5]


@pytest.mark.parametrize("form, out, program, options, code, says", [
    ("ros2", "a.yaml", PROGRAM, (), 2, ["ros2", "trajectories", "plan the program"]),
    ("csv", "a.csv", PROGRAM, (), 2, ["csv", "trajectories"]),
    ("urscript", "a.script", PROGRAM + SPLINES, (), 3, ["cell.csv:10: ", "spline", "krl"]),
    ("rapid", "a.mod", PROGRAM + SPLINES, (), 3, ["cell.csv:10: ", "spline", "krl"]),
    ("krl", "a.src", PROGRAM.replace("arc,", "screw,").replace("via,previous", "line,previous"), (), 3,
     ["cell.csv:7: ", "screw"]),
    ("urscript", "a.script", PROGRAM, ("--rate", "125"), 2, ["rate", "trajectories"]),
    ("urscript", "a.script", "x,y,z,roll,pitch,yaw\n0,0,0,0,0,0\n", (), 3, ["has poses of the tool", "--through"]),
    ("urscript", "a.script", HEAD.replace("x,y,z,roll,pitch,yaw", "x,y,z") + "line,,0.4,0,0.4,,,,\n", (), 3,
     ["x,y,z gives no orientation"]),
    ("krl", "loop.src", PROGRAM, (), 2, ['"loop"', "KRL"]),
])
def test_what_a_form_cannot_hold_is_refused(refused, written, tmp_path, form, out, program, options, code,
                                            says):
    written("cell.csv", program)
    start = START if "x,y,z,roll" in program and "motion" in program else ()
    refused(code, "export", "ur5e", "cell.csv", *start, "--as", form, "--out", out, *options, says=says)
    assert [path.name for path in tmp_path.iterdir()] == ["cell.csv"]


def test_options_of_programs_are_refused_for_trajectories(refused, beeline, written):
    joints = ",".join(f"joint{i}" for i in range(1, 7))
    written("t.csv", f"t,{joints}\n0,0,0,0,0,0,0\n1,0,0,0,0,0,1\n")
    for option in (("--from", "0,0,0,0,0,0"), ("--work", "0,0,0"), ("--blend", "1"), ("--tool-speed", "1")):
        refused(2, "export", "ur5e", "t.csv", "--as", "krl", "--out", "a.src", *option, says=[option[0]])


def test_a_program_that_is_not_possible_is_not_exported(beeline, written, tmp_path):
    written("cell.csv", PROGRAM.replace("-0.4,-0.3,0.2", "-1.4,-0.3,0.2"))
    answer = beeline("export", "ur5e", "cell.csv", *START, "--as", "krl", "--out", "a.src", "--json")
    assert answer.code == 1 and answer.json["status"] == "unreachable", answer.err
    assert "cell.csv:" in answer.json["reason"] and not (tmp_path / "a.src").exists()
