"""line's branches, paths and profiles, move --method quickest, diff: as a user would call them."""

import csv

import pytest

from profiles import PROFILES

READY = "0,-0.785,0,-2.356,0,1.571,0.785"
POSES = ("x,y,z,roll,pitch,yaw\n0.45,-0.2,0.5,3.14159,0,0\n0.5,0.1,0.4,3.14159,0,0.3\n"
         "0.4,0.2,0.5,3.14159,0.1,0.6\n")


def test_the_branches_are_listed_best_first(beeline, written):
    through = written("poses.csv", POSES)
    answer = beeline("line", "ur5", "--through", through, "--branches", "--json").json
    branches = answer["branches"]
    assert len(branches) == 8 and answer["status"] == "reached"
    done = [branch["path_parameter"] for branch in branches]
    assert done == sorted(done, reverse=True) and done[0] == 2
    for branch in branches:
        assert (branch["status"] == "reached") == (branch["path_parameter"] == 2) == (branch["reason"] == "")
    text = beeline("line", "ur5", "--through", through, "--branches").out
    assert "branches      8" in text


@pytest.mark.parametrize("profile", PROFILES)
def test_every_profile_follows_the_line(beeline, written, profile):
    through = written("poses.csv", POSES)
    made = beeline("line", "panda", "--through", through, "--profile", profile, "--rate", "250", "--out",
                   "m.csv", "--json")
    assert made.code == 0 and made.json["limits"]["velocity"]["fraction"] <= 1 + 1e-6
    checked = beeline("check", "panda", "m.csv", "--through", through, "--json").json
    assert checked["fault"] in ((None, "jerk") if profile in ("fastest", "trapezoidal") else (None,))


@pytest.mark.parametrize("path", ["screw", "arc", "spline"])
def test_other_paths(beeline, written, path):
    through = written("poses.csv", POSES)
    answer = beeline("line", "panda", "--through", through, "--path", path, "--json")
    assert answer.code == 0, answer.err
    assert answer.json["deviation_bound"] <= 1e-4 and answer.json["deviation_sampled"] <= 1e-6


def test_blended_corners_are_quicker(beeline, written):
    through = written("poses.csv", POSES)
    sharp = beeline("line", "panda", "--through", through, "--json").json
    blended = beeline("line", "panda", "--through", through, "--blend", "0.02", "--json").json
    assert blended["status"] == "reached" and blended["duration"] < sharp["duration"]


def test_a_line_out_of_reach_comes_with_a_nearby_one_that_works(beeline, written):
    through = written("far.csv", "x,y,z,roll,pitch,yaw\n0.5,-0.3,0.5,3.14159,0,0\n"
                                 "0.8,0.3,0.5,3.14159,0,0.6\n")
    answer = beeline("line", "ur5", "--through", through, "--json")
    assert answer.code == 1 and answer.json["status"] == "unreachable"
    moved = answer.json["nearby"][0]["translation"]
    assert moved[0] < -0.05 and "every waypoint moved by 0.0" in answer.json["nearby"][0]["description"]
    x, y, z = moved
    rows = [[0.5 + x, -0.3 + y, 0.5 + z, 3.14159, 0, 0], [0.8 + x, 0.3 + y, 0.5 + z, 3.14159, 0, 0.6]]
    text = "x,y,z,roll,pitch,yaw\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows)
    assert beeline("line", "ur5", "--through", written("near.csv", text)).code == 0


def test_the_quickest_move(beeline, tmp_path):
    goal = "0.5,-0.3,0.2,-1.9,0.1,2,0.3"
    command = ("move", "panda", "--from", READY, "--to", goal, "--method", "quickest")
    answer = beeline(*command, "--rate", "1000", "--out", "m.csv", "--json").json
    assert answer["status"] == "reached" and answer["error"] == 0
    rows = list(csv.DictReader((tmp_path / "m.csv").open()))
    assert [float(rows[-1][f"joint{i}"]) for i in range(1, 8)] == [float(q) for q in goal.split(",")]
    assert float(rows[-1]["t"]) == answer["duration"]
    straight = beeline(*command, "--synchronise", "straight", "--json").json
    assert straight["duration"] >= answer["duration"] - 1e-9


@pytest.mark.parametrize("method", ["feedback", "quickest"])
def test_a_goal_outside_the_limits_is_a_no(beeline, method):
    answer = beeline("move", "panda", "--from", READY, "--to", "0,0,0,1,0,1,0", "--method", method,
                     "--json")
    assert answer.code == 1 and answer.json["status"] == "outside_limits"
    assert "joint4" in answer.json["reason"] and answer.json["reason"] in answer.err


def test_control_reports_the_limits_that_it_uses_and_the_jump_at_its_start(beeline, written):
    """K_p times the largest error, 0.2 rad, in a step of 0.02 s: 1 rad/s."""
    command = ("move", "panda", "--from", "0,0,0,-1.5,0,1.5,0", "--to", "0,0.2,0,-1.5,0.1,1.5,0")
    answer = beeline(*command, "--json", "--out", "move.csv").json
    jump = answer["start_jump"]
    assert (jump["joint"], jump["assumed"]) == ("joint2", False)
    assert jump["velocity"] == pytest.approx(1) and jump["fraction"] == pytest.approx(1 / 2.175)
    assert answer["limits"]["velocity"]["fraction"] == pytest.approx(1 / 2.175)
    # The differences after the first step: a tenth of 1 rad/s in a step.
    assert answer["limits"]["acceleration"]["fraction"] == pytest.approx(5 / 7.5)
    assert not answer["limits"]["acceleration"]["exact"]
    fault = beeline("check", "panda", "move.csv", "--json", "--moving-end").json["faults"]
    assert "moving" in [kind["fault"] for kind in fault]
    text = beeline(*command).out
    assert "start         jumps from rest to 1 rad/s, 46 % of the limit, joint joint2\n" in text
    assert "acceleration  at most " in text
    degrees = beeline("move", "panda", "--from", "0,0,0,-90,0,90,0", "--to", "0,10,0,-90,0,90,0", "--degrees")
    assert "jumps from rest to 50 deg/s, 40.1 % of the limit, joint joint2" in degrees.out
    quick = beeline(*command, "--method", "quickest", "--json").json
    assert quick["start_jump"] is None and quick["limits"]["acceleration"]["fraction"] <= 1 + 1e-6
    assert "jumps" not in beeline(*command, "--method", "quickest").out
    through = written("poses.csv", "x,y,theta\n4,4,0.5\n")
    line = ("line", "rrr", "--from", "0,1.5,0", "--through", through, "--method", "inverse-jacobian")
    by_control = beeline(*line, "--json").json
    assert by_control["start_jump"]["assumed"] and by_control["limits"]["velocity"]["fraction"] > 0
    assert "start         jumps from rest to" in beeline(*line).out and "of the assumed limit" in beeline(*line).out


def test_one_step_is_singular(beeline):
    answer = beeline("move", "rrr", "--from", "0,0,0", "--to", "1,0,0", "--max-steps", "1")
    assert answer.code == 1 and "after 1 step of 0.02 s" in answer.out
    assert "after 1 step the error is 0.9" in answer.err


def test_a_recording_differs_from_another_one_and_not_from_itself(beeline):
    command = ("move", "panda", "--from", READY, "--method", "quickest", "--rate", "200")
    beeline(*command, "--to", "0.5,-0.3,0.2,-1.9,0.1,2,0.3", "--out", "a.csv")
    beeline(*command, "--to", "0.5,-0.3,0.2,-1.9,0.1,2,0.4", "--out", "b.csv")
    same = beeline("diff", "panda", "a.csv", "a.csv", "--tolerance", "0", "--json")
    assert same.code == 0 and same.json["position"] == 0
    apart = beeline("diff", "panda", "a.csv", "b.csv", "--tolerance", "0.01", "--json")
    assert apart.code == 1 and "joint7" in apart.err
    largest = {joint["joint"]: joint["largest"] for joint in apart.json["joints"]}
    assert largest["joint7"] == pytest.approx(0.1, abs=0.02) and largest["joint1"] < 0.02


REFUSED = [
    (("line", "panda", "--through", "p.csv", "--profile", "fast"), ["fast", "s-curve"]),
    (("line", "panda", "--through", "p.csv", "--path", "curve"), ["curve", "spline"]),
    (("line", "panda", "--through", "p.csv", "--path", "arc", "--blend", "1"), ["--blend"]),
    (("line", "panda", "--through", "p.csv", "--blend", "-1"), ["-1"]),
    (("line", "panda", "--through", "p.csv", "--rate", "-5"), ["rate", "-5"]),
    (("line", "panda", "--through", "p.csv", "--method", "inverse-jacobian"), ["--from"]),
    (("move", "panda", "--from", READY, "--to", READY, "--method", "fast"), ["fast", "quickest"]),
    (("move", "panda", "--from", READY, "--to", READY, "--rate", "5"), ["--rate", "feedback"]),
    (("move", "panda", "--from", READY, "--to", READY, "--method", "quickest", "--kp", "1"),
     ["--kp", "quickest"]),
    (("diff", "panda", "p.csv", "p.csv", "--tolerance", "-1"), ["--tolerance"]),
]


@pytest.mark.parametrize("arguments, says", REFUSED, ids=lambda value: " ".join(value)[:70])
def test_bad_usage(refused, written, arguments, says):
    written("p.csv", POSES)
    refused(2, *arguments, says=says)
