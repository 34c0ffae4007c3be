"""Limits of the user: --limits, --velocity, --acceleration, --jerk and --speed."""

import math
import re

import pytest

MOVEIT = """default_velocity_scaling_factor: 0.1
joint_limits:
  joint1: {has_velocity_limits: true, max_velocity: 1, has_acceleration_limits: false, max_jerk: 500}
  joint2:
    max_position: !degrees 45
  finger: {max_velocity: 0.1}
"""
WAYPOINTS = "joint1,joint2,joint3,joint4,joint5,joint6,joint7\n0,0,0,-1.9,0,1.9,0\n1,0.5,0.2,-1.4,0.5,1.4,1\n"
PANDA = ("--from", "0,0,0,-1.9,0,1.9,0", "--to", "1,0.5,0.2,-1.4,0.5,1.4,1")
USES_LIMITS = ["show", "fk", "jacobian", "ik", "batch fk", "batch ik", "move", "line", "check",
               "retime", "replay", "draw"]


def limits(answer):
    return [joint["limits"] for joint in answer.json["joints"]]


def test_a_file_replaces_limits_and_says_what_is_not_applied(beeline, written):
    before = limits(beeline("show", "panda", "--json"))
    answer = beeline("show", "panda", "--limits", written("l.yaml", MOVEIT), "--json")
    assert limits(answer)[0] == {**before[0], "velocity": 1, "acceleration": None, "jerk": 500}
    assert limits(answer)[1] == {**before[1], "upper": math.radians(45)}
    assert limits(answer)[2:] == before[2:]
    assert answer.err.replace("beeline: warning: ", "").splitlines() == [
        "l.yaml: default_velocity_scaling_factor 0.1 is not applied; set a speed scale instead",
        "l.yaml: arm panda does not have finger",
        "l.yaml: has_acceleration_limits is false, so no limit is known: joint1",
    ]
    text = beeline("show", "panda", "--limits", "l.yaml").out
    assert re.search(r"\b4 a\b", text.splitlines()[3]) and " a" not in text.splitlines()[4][30:]
    joints = beeline("show", "panda", "--limits", "l.yaml", "--json").json["joints"]
    assert [joint["assumed"] for joint in joints] == [{"acceleration": 4}] + 6 * [{}]


def test_a_json_file_too(beeline, written):
    path = written("l.json", '{"joint2": {"lower": -0.5, "velocity": 0.25, "jerk": 7}}')
    joint = limits(beeline("show", "panda", "--limits", path, "--json"))[1]
    assert (joint["lower"], joint["velocity"], joint["jerk"]) == (-0.5, 0.25, 7)


@pytest.mark.parametrize("name, text", [
    ("l.json", '{"shoulder_pan_joint": {"velocity": 0.5}}'),
    ("l.yaml", "joint_limits:\n  shoulder_pan_joint: {has_velocity_limits: true, max_velocity: 0.5}\n")])
def test_makers_names_of_a_built_in_arm_are_known(beeline, refused, written, name, text):
    path = written(name, text)
    assert limits(beeline("show", "ur5e", "--limits", path, "--json"))[0]["velocity"] == 0.5
    refused(3, "show", "panda", "--limits", path, says=["shoulder_pan_joint"])
    twice = written("t.json", '{"joint1": {}, "shoulder_pan_joint": {}}')
    refused(3, "show", "ur5e", "--limits", twice, says=["joint1", "twice"])


def test_options_replace_limits_in_the_unit_of_the_joint(beeline, written):
    slow = limits(beeline("show", "scara", "--velocity", "90,180,0.5,360", "--degrees",
                          "--acceleration", "5", "--json"))
    assert [joint["velocity"] for joint in slow] == pytest.approx([90, 180, 0.5, 360])
    assert [joint["acceleration"] for joint in slow] == pytest.approx([5, 5, 5, 5])
    radians = limits(beeline("show", "scara", "--velocity", "1,2,0.5,3", "--jerk", "9", "--json"))
    assert [joint["velocity"] for joint in radians] == [1, 2, 0.5, 3]
    assert [joint["jerk"] for joint in radians] == [9, 9, 9, 9]
    written("l.yaml", MOVEIT)
    both = limits(beeline("show", "panda", "--limits", "l.yaml", "--velocity", "2", "--json"))
    assert both[0]["velocity"] == 2 and both[0]["jerk"] == 500


def test_speed_scales_by_the_powers(beeline):
    before = limits(beeline("show", "panda", "--json"))[0]
    half = limits(beeline("show", "panda", "--speed", "0.5", "--json"))[0]
    assert half["upper"] == before["upper"]
    assert half["velocity"] == before["velocity"] / 2
    assert half["acceleration"] == before["acceleration"] / 4
    assert half["jerk"] == before["jerk"] / 8
    assert limits(beeline("show", "rrr", "--speed", "0.5", "--json"))[0]["velocity"] is None


@pytest.mark.parametrize("arm", ["panda", "rrr"])  # with limits that are known, or assumed
def test_at_half_the_speed_a_motion_takes_twice_the_time(beeline, written, arm):
    path = written("w.csv", WAYPOINTS if arm == "panda" else "joint1,joint2,joint3\n0,1,0\n1,0,0\n")
    ends = PANDA if arm == "panda" else ("--from", "0,1,0", "--to", "1,0,0")
    move = ("move", arm, *ends, "--method", "quickest", "--rate", "1000", "--json")
    for command in (("retime", arm, path, "--json"), move):
        whole = beeline(*command).json["duration"]
        assert beeline(*command, "--speed", "0.5").json["duration"] == pytest.approx(2 * whole, rel=1e-2)


def test_a_planned_motion_keeps_the_limits_and_is_checked_against_them(beeline, written):
    through = written("p.csv", "x,y,theta\n4.5,5.2,0\n2,6,45\n")
    own = ("--velocity", "20", "--acceleration", "60", "--jerk", "400", "--degrees")
    made = beeline("line", "rrr", "--from", "0,90,0", "--through", through, *own, "--out", "m.csv",
                   "--json")
    assert made.code == 0, made.err
    assert 0.5 < made.json["limits"]["velocity"]["fraction"] <= 1 + 1e-6
    assert beeline("check", "rrr", "m.csv", "--through", through, *own).code == 0
    tight = beeline("check", "rrr", "m.csv", "--through", through, *own, "--speed", "0.5", "--json")
    assert tight.code == 1 and tight.json["fault"] in ("velocity", "acceleration", "jerk")
    assert beeline("replay", "rrr", "m.csv", *own).code == 0
    fast = beeline("replay", "rrr", "m.csv", *own, "--speed", "2", "--json")
    assert fast.code == 1 and fast.json["status"] == "outside_limits"


def test_position_limits_of_a_file_bound_the_solutions(ik, written):
    path = written("l.json", '{"joint2": {"upper": 0}}')
    assert ik("rrr", "4.459,5.226,0")["status"] == "solved"
    q = ik("rrr", "4.459,5.226,0", "--limits", path)["solutions"][0]
    assert q[1] <= 0
    path = written("n.json", '{"joint2": {"lower": 3, "upper": 3.1}}')
    assert ik("rrr", "4.459,5.226,0", "--limits", path)["status"] == "outside_limits"


@pytest.mark.parametrize("verb", USES_LIMITS)
def test_every_verb_that_uses_limits_takes_them(beeline, verb):
    options = beeline(*verb.split(), "--help").out.split("\nExamples:\n")[0]
    assert "\n  --limits FILE" in options
    if verb in ("show", "move", "line", "check", "retime", "replay"):
        assert all(f"\n  --{name} " in options for name in ("velocity", "acceleration", "jerk", "speed"))


BAD_OPTIONS = [
    (("--velocity", "0"), ["--velocity must be above 0, not 0"]),
    (("--velocity", "-1,1,1"), ["--velocity must be above 0, not -1"]),
    (("--velocity", "1,2"), ["--velocity takes one number, or 3 (joint1, joint2, joint3), not 2"]),
    (("--acceleration", "nan"), ["--acceleration: item 1", "finite"]),
    (("--acceleration", "1,,2"), ["--acceleration: item 2", "missing"]),
    (("--jerk", "fast"), ["--jerk: item 1", "fast"]),
    (("--jerk", "1e-300"), ["jerk limit 1e-300 is below 1e-09"]),
    (("--speed", "0"), ["--speed", "from 1e-06 to 1"]),
    (("--speed", "1.5"), ["--speed", "from 1e-06 to 1"]),
    (("--speed", "1e-5", "--jerk", "1"), ["--speed: the speed scale 1e-05 is too small"]),
]


@pytest.mark.parametrize("options, says", BAD_OPTIONS, ids=lambda value: " ".join(value)[:40])
def test_bad_options_are_refused_in_one_line(refused, options, says):
    refused(2, "show", "rrr", *options, says=says)


BAD_FILES = [
    ("l.yaml", "joint_limits:\n  joint1:\n    max_velocity: fast\n", ["l.yaml:3", "joint1.max_velocity", "fast"]),
    ("l.yaml", "joint_limits:\n  joint9: {}\n", ["l.yaml:1", "joint9", "joint1, joint2, joint3"]),
    ("l.yaml", "joint_limits: [1", ["l.yaml:1", "is not YAML"]),
    ("l.yaml", "", ["l.yaml", "has no key joint_limits"]),
    ("l.json", '{"joint9": {}}', ["l.json:1", "joint9", "joint1, joint2, joint3"]),
    ("l.json", '{"joint1": {"upper": -2, "lower": 2}}', ["joint1", "lower 2 exceeds upper -2"]),
    ("l.json", "{", ["l.json:1", "is not JSON"]),
]


@pytest.mark.parametrize("name, text, says", BAD_FILES, ids=lambda value: str(value)[:30])
def test_bad_files_are_refused_in_one_line(refused, written, name, text, says):
    refused(3, "fk", "rrr", "--q", "0,0,0", "--limits", written(name, text), says=says)


def test_missing_files_and_overwriting_are_refused(refused, written):
    refused(3, "show", "rrr", "--limits", "none.yaml", says=["none.yaml"])
    path = written("l.json", "{}")
    refused(2, "show", "rrr", "--limits", path, "--out", path, says=["l.json", "input"])
