"""move --method around: joint motions around obstacles, proved."""

import csv
import json

import pytest

from shaped_arm import planar_arm

START, GOAL = "100,-60,20", "-20,40,30"  # degrees


def ball(name, at, radius):
    return {"name": name, "shapes": [{"sphere": {"radius": radius}, "pose": {"xyz": at}}]}


@pytest.fixture
def cell(beeline, written):
    """cell(*options) -> the answer of a motion past a ball that the quickest motion hits."""
    written("arm.json", planar_arm())
    written("cell.json", json.dumps({"obstacles": [ball("post", [6.2, 3.4, 0], 0.8)]}))
    return lambda *options, start=START, method="around": beeline(
        "move", "arm.json", "--from", start, "--degrees", "--scene", "cell.json", "--method", method, *options)


def test_a_motion_goes_around_what_the_quickest_one_hits(cell, beeline, tmp_path):
    assert cell("--to", GOAL, method="quickest").code == 1
    answer = cell("--to", GOAL, "--out", "m.csv", "--draw", "d.svg", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["status"] == "reached"
    assert answer.json["clearance"]["status"] == "clear"
    path = answer.json["path"]
    assert len(path["waypoints"]) >= 3 and len(path["blends"]) == len(path["waypoints"]) - 2
    assert path["waypoints"][0] == pytest.approx([float(x) for x in START.split(",")])
    assert path["waypoints"][-1] == pytest.approx([float(x) for x in GOAL.split(",")])
    rows = list(csv.DictReader(open(tmp_path / "m.csv")))
    assert float(rows[-1]["t"]) == answer.json["duration"]
    checked = beeline("check", "arm.json", "m.csv", "--scene", "cell.json", "--json")
    assert checked.code == 0 and checked.json["clearance"]["status"] == "clear"
    assert answer.json["limits"]["velocity"]["fraction"] <= 1.0001
    again = cell("--to", GOAL, "--out", "n.csv")
    assert (tmp_path / "n.csv").read_bytes() == (tmp_path / "m.csv").read_bytes()
    assert "straight joint motions, length" in again.out
    slow = cell("--to", GOAL, "--duration", "20", "--json")
    assert slow.code == 0 and slow.json["duration"] == 20, slow.err
    assert cell("--to", GOAL, "--duration", "20", "--rate", "100").code == 2
    stops = cell("--to", GOAL, "--joint-blend", "0", "--json").json
    assert stops["duration"] > answer.json["duration"] and set(stops["path"]["blends"]) == {0.0}


def test_a_goal_is_a_pose(cell, beeline):
    def pose_at(q):
        planar = beeline("fk", "arm.json", f"--q={q}", "--degrees", "--json").json["pose"]["planar"]
        return [planar[key] for key in ("x", "y", "theta")]

    cell("--to", GOAL)  # writes the arm
    pose = pose_at(GOAL)
    answer = cell("--pose", ",".join(map(str, pose)), "--json")
    assert answer.code == 0, answer.err
    end = ",".join(map(str, answer.json["path"]["waypoints"][-1]))
    assert pose_at(end) == pytest.approx(pose, abs=1e-5)
    far = cell("--pose", "90,0,0", "--json")
    assert far.code == 1 and far.json["status"] == "unreachable" and far.json["reason"]


def test_ends_that_are_not_free_are_named(cell):
    inside = "20,10,10"
    answer = cell("--to", inside, "--json")
    assert answer.code == 1 and answer.json["status"] == "collides" and answer.json["code"] == "goal_not_free"
    assert "post" in answer.json["reason"]
    answer = cell("--to", GOAL, start=inside)
    assert answer.code == 1 and answer.err.startswith("beeline: at the start ") and "post" in answer.err


def test_what_is_not_found_is_said(cell, tmp_path):
    answer = cell("--to", GOAL, "--max-edges", "1", "--out", "m.csv", "--json")
    assert answer.code == 1 and answer.json["status"] == "not_found" and answer.json["code"] == "no_free_path"
    assert "one may exist" in answer.json["reason"] and not (tmp_path / "m.csv").exists()
    ended = cell("--to", GOAL, "--max-work", "0", "--json")
    assert ended.code == 1 and ended.json["status"] == "work_limit"


@pytest.mark.parametrize("options, said", [
    (("--to", GOAL, "--pose", "3,3,0"), "--to and --pose are two goals"),
    ((), "move needs --to"),
    (("--to", GOAL, "--joint-blend", "-1"), "--joint-blend"),
    (("--to", GOAL, "--max-edges", "0"), "--max-edges"),
])
def test_refusals(cell, options, said):
    answer = cell(*options)
    assert answer.code == 2 and said in answer.err, answer.err


def test_a_scene_is_needed(beeline, written):
    written("arm.json", planar_arm())
    answer = beeline("move", "arm.json", "--from", START, "--to", GOAL, "--degrees", "--method", "around")
    assert answer.code == 2 and "--scene" in answer.err
