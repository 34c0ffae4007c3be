"""Parts that a program attaches: rows attach and detach, with --scene."""

import csv
import json

import pytest

from shaped_arm import planar_arm

START = ("--from", "110,-60,-140", "--degrees")
PICK = """motion,relative,x,y,theta,speed,dwell,part,touch
joint,next,{lift},0,0,,,,
line,,3,2.45,-90,0.5,0.3,,
attach,,,,,,,box,{touch}
line,previous,{lift},0,0,,,,
line,next,{lift},0,0,,,,
line,,4.4,2.45,-90,0.5,0.3,,
detach,,,,,,,box,
line,previous,{lift},0,0,,,,
"""


def body(name, size, at):
    return {"name": name, "shapes": [{"box": {"size": size}, "pose": {"xyz": at}}]}


@pytest.fixture
def cell(beeline, written):
    """cell(pick, *options) -> the answer of line for a pick in a cell with a box, a bench, a fence."""
    written("arm.json", planar_arm())
    written("cell.json", json.dumps({"obstacles": [
        body("box", [0.6, 0.6, 0.6], [3, 2.0, 0]), body("bench", [3, 0.4, 1], [3.7, 1.5, 0]),
        body("fence", [0.1, 0.7, 1], [3.7, 2.05, 0])]}))

    def plan(pick, *options, scene=("--scene", "cell.json"), verb="line"):
        written("pick.csv", pick)
        return beeline(verb, "arm.json", *START, *(("--through",) if verb == "line" else ()), "pick.csv",
                       *scene, *options)

    return plan


def pick(lift=-0.8, touch="bench"):
    return PICK.format(lift=lift, touch=touch)


def test_a_pick_is_proved_with_its_part(cell, beeline, tmp_path):
    answer = cell(pick(), "--out", "m.csv", "--plot", "p.svg", "--draw", "d.svg", "--json")
    assert answer.code == 0, answer.err
    clearance = answer.json["clearance"]
    [box] = clearance["attachments"]
    moves = answer.json["moves"]
    rows = list(csv.DictReader(open(tmp_path / "m.csv")))
    assert box["part"] == "box" and box["touch"] == ["bench"]
    assert (box["row"], box["place"], box["detach_place"]) == (4, "pick.csv:4", "pick.csv:8")
    assert box["time"] == float(rows[moves[1]["end"] - 1]["t"])
    assert box["detach_time"] == float(rows[moves[4]["end"] - 1]["t"])
    # The box is 0.45 m below the tool, which points down: ahead of it along its x axis.
    assert [row[3] for row in box["tool_T_part"][:3]] == pytest.approx([0.45, 0, 0], abs=1e-9)
    check = ("check", "arm.json", "m.csv", "--degrees", "--through", "pick.csv", "--scene", "cell.json")
    checked = beeline(*check, "--json", "--plot", "c.svg")
    assert checked.code == 0, checked.err
    assert checked.json["clearance"]["attachments"] == [box]
    assert checked.json["clearance"]["least_distance"] == pytest.approx(clearance["least_distance"])
    text = beeline(*check).out
    assert "attached      box from " in text and "may touch bench" in text
    assert (tmp_path / "p.svg").stat().st_size > 1000 and (tmp_path / "c.svg").stat().st_size > 1000


def test_the_part_is_what_hits_the_fence(cell):
    answer = cell(pick(lift=-0.3), "--json")
    assert answer.code == 1 and answer.json["status"] == "collides"
    assert answer.json["clearance"]["pair"] == ["box", "fence"]
    assert answer.json["failed_move"] == 4 and answer.json["failed_place"] == "pick.csv:6"
    assert answer.json["fields"]["move"] == 4
    assert "move 4 (line, pick.csv:6), at " in answer.err
    assert "name fence in the column touch of pick.csv:4" in answer.err
    without = "".join(row for row in pick(lift=-0.3).splitlines(True) if "tach" not in row)
    assert cell(without).code == 0


def test_touch_exempts_what_it_names(cell):
    assert cell(pick(touch='"bench, fence"', lift=-0.3)).code == 0
    answer = cell(pick(touch="fence"), "--json")
    assert answer.code == 1 and answer.json["clearance"]["pair"] == ["box", "bench"]
    assert answer.err.startswith("beeline: attach box (pick.csv:4), at "), answer.err
    assert cell(pick(touch=""), "--allow", "box,bench").code == 0


def test_a_trajectory_that_is_not_the_program_is_not_proved_clear(cell, beeline):
    assert cell(pick(), "--out", "m.csv").code == 0
    cell(pick().replace("4.4,2.45", "4.3,2.45"))
    answer = beeline("check", "arm.json", "m.csv", "--degrees", "--through", "pick.csv", "--scene",
                     "cell.json", "--json")
    assert answer.code == 1 and answer.json["checked"] == ["limits", "path"]
    assert "clearance" not in answer.json


def test_scenes_are_asked_for(cell, beeline):
    for verb, options in (("line", ()), ("line", ("--self",))):
        answer = cell(pick(), *options, scene=(), verb=verb)
        assert answer.code not in (0, 1) and "pick.csv:4: " in answer.err
        assert "--scene" in answer.err or "no obstacle" in answer.err
        assert answer.err.count("\n") == 1
    assert cell(pick(), "--out", "m.csv").code == 0
    answer = beeline("check", "arm.json", "m.csv", "--degrees", "--through", "pick.csv")
    assert answer.code not in (0, 1) and "pick.csv:4: attach needs" in answer.err


@pytest.mark.parametrize("old, new, line, says", [
    (",box,bench", ",bax,bench", 8, '"box" is not attached here'),
    ("box", "bax", 4, 'unknown obstacle "bax"; did you mean "box"?'),
    ("box,bench", "box,bunch", 4, 'unknown link or obstacle "bunch"; did you mean "bench"?'),
    ("box,bench", "box,box", 4, "the part itself"),
    ("detach,,,,,,,box", "detach,,,,,,,fence", 8, '"fence" is not attached here'),
    ("line,previous", "attach,,,,,,,box,\nline,previous", 5, '"box" is attached already, by row pick.csv:4'),
    ("line,previous", "detach,,,,,,,box,\nline,previous", 5, "detached before a move carries it"),
    ("attach,,,", "attach,next,,", 4, "attach moves nothing"),
    ("attach,,,,,,,", "attach,,,,,,1,", 4, "attach moves nothing"),
    ("attach,,,,,", "attach,,1,2,3,", 4, "attach moves nothing"),
    ("attach,,,,,,,box", "attach,,,,,,,", 4, "needs the name of an obstacle"),
    ("0.5,0.3,,", "0.5,0.3,box,", 3, "part and touch are for rows"),
    ("box,\n", "box,bench\n", 8, "touch is for attach"),
    ("box,bench", 'box,"bench,,fence"', 4, "column touch has an empty name"),
    ("attach,", "attatch,", 4, 'unknown motion "attatch"'),
])
def test_hostile_rows_are_refused_in_one_line(cell, old, new, line, says):
    count = -1 if (old, new) in (("box", "bax"), ("box,\n", "box,bench\n")) else 1
    answer = cell(pick().replace(old, new, count))
    assert answer.code not in (0, 1), answer.out
    assert f"pick.csv:{line}: " in answer.err and says in answer.err
    assert answer.err.count("\n") == 1


def test_a_picture_shows_the_part_where_it_is_carried(cell, beeline, tmp_path):
    """The whole animation has the box, which the tool lifts over the fence."""
    assert cell(pick(), "--out", "m.csv", "--draw", "d.svg").code == 0
    drawn = ("draw", "arm.json", "m.csv", "--degrees", "--scene", "cell.json", "--animate")
    assert beeline(*drawn, "parts.svg", "--through", "pick.csv").code == 0
    assert beeline(*drawn, "still.svg").code == 0
    assert (tmp_path / "parts.svg").read_bytes() != (tmp_path / "still.svg").read_bytes()
    again = beeline("draw", "arm.json", "m.csv", "--degrees", "--scene", "cell.json", "--out", "e.svg",
                    "--through", "pick.csv")
    assert again.code == 0, again.err
    assert (tmp_path / "e.svg").read_bytes() == (tmp_path / "d.svg").read_bytes()


def test_a_program_that_is_not_followed_has_no_picture(cell, beeline, tmp_path, written):
    assert cell(pick(), "--out", "m.csv").code == 0
    written("pick.csv", pick().replace("4.4,2.45", "4.6,2.45"))
    answer = beeline("draw", "arm.json", "m.csv", "--degrees", "--scene", "cell.json", "--through", "pick.csv",
                     "--out", "d.svg")
    assert answer.code not in (0, 1) and "m.csv is no motion of this program: " in answer.err
    assert not (tmp_path / "d.svg").exists()


@pytest.mark.parametrize("lift", [-0.8, -0.3])
def test_a_refusal_is_drawn_where_it_is(cell, tmp_path, lift):
    """The box hits the fence on a low way; without the exemption it hits the bench where it stands."""
    answer = cell(pick(lift, touch="bench" if lift == -0.3 else ""), "--out", "m.csv", "--draw", "d.svg",
                  "--plot", "p.svg", "--json")
    assert answer.code == 1
    clearance = answer.json["clearance"]
    assert clearance["picture"] == "d.svg"
    assert clearance["pair"] in (["box", "fence"], ["box", "bench"], ["fence", "box"], ["bench", "box"])
    picture = (tmp_path / "d.svg").read_text()
    assert "box" in picture and "arm at" not in picture.split("<title>")[0]
    assert not (tmp_path / "m.csv").exists() and not (tmp_path / "p.svg").exists()


def test_a_part_is_not_attached_while_the_tool_passes(cell):
    rows = ("motion,x,y,theta,blend,part\njoint,3,3.2,-90,,\nline,3,3,-90,0.1,\nattach,,,,,box\n"
            "line,4,3,-90,,\n")
    answer = cell(rows)
    assert answer.code not in (0, 1) and answer.err.count("\n") == 1
    assert "pick.csv:4: the tool passes move 2 (line, pick.csv:3) without a stop" in answer.err


def test_blends_of_all_corners_leave_stops_for_parts(cell):
    assert cell(pick(), "--blend", "0.05").code == 0


AWAY_AND_BACK = "motion,x,y,theta\njoint,3,2.45,-90\njoint,3,3.6,-90\njoint,3,2.45,-90\njoint,3.3,3.6,-90\n"
CARRY = "motion,x,y,theta,part,touch\njoint,3,2.45,-90,,\nattach,,,,box,bench\njoint,3.3,3.6,-90,,\n"


def test_a_second_rest_at_the_waypoint_is_refused(cell, beeline, written, tmp_path):
    """The part may be attached at the first, and hit something that it would not after the second."""
    assert cell(AWAY_AND_BACK, "--out", "m.csv", scene=()).code == 0
    written("carry.csv", CARRY)
    check = ("check", "arm.json", "m.csv", "--degrees", "--through", "carry.csv", "--scene", "cell.json")
    answer = beeline(*check)
    assert answer.code not in (0, 1) and answer.err.count("\n") == 1
    assert "carry.csv:3: the arm rests at the waypoint of move 1" in answer.err and " and again at " in answer.err
    rows = AWAY_AND_BACK.replace("\n", ",,\n").replace("theta,,", "theta,part,touch").splitlines()
    rows.insert(4, "attach,,,,box,bench")
    written("carry.csv", "\n".join(rows) + "\n")
    assert beeline(*check).code == 0
    for end in ("--moving-start", "--moving-end"):
        refused = beeline(*check, end)
        assert refused.code == 2 and f"{end} does not go together" in refused.err


def test_a_part_meets_the_arm_without_pairs_of_links(beeline, written):
    """The hand folds its box into the upper arm."""
    written("arm.json", planar_arm())
    written("cell.json", json.dumps({"obstacles": [body("box", [0.6, 0.6, 0.6], [3, 2.1, 0])]}))
    written("fold.csv", "motion,x,y,theta,q,part\njoint,3,2.45,-90,,\nattach,,,,,box\njoint,,,,\"110,-150,-120\",\n")
    fold = ("line", "arm.json", *START, "--through", "fold.csv", "--scene", "cell.json", "--json")
    answers = [beeline(*fold, *options) for options in ((), ("--no-self",))]
    assert [answer.code for answer in answers] == [1, 1], [answer.err for answer in answers]
    assert answers[0].json["clearance"]["pair"] == answers[1].json["clearance"]["pair"]
    assert "box" in answers[0].json["clearance"]["pair"]


def test_a_part_with_a_larger_clearance_of_its_own_is_refused(cell, written):
    scene = {"obstacles": [body("box", [0.6, 0.6, 0.6], [3, 2.0, 0]) | {"clearance": 0.2}]}
    written("clear.json", json.dumps(scene))
    answer = cell(pick(touch=""), scene=("--scene", "clear.json"))
    assert answer.code not in (0, 1) and answer.err.count("\n") == 1
    assert "pick.csv:4: the obstacle has a clearance of its own, 0.2 m" in answer.err
    assert cell(pick(touch=""), "--clearance", "0.2", scene=("--scene", "clear.json")).code in (0, 1)


def test_an_exported_program_says_what_it_carries(beeline, written, tmp_path):
    scene = {"obstacles": [body("part", [0.05, 0.05, 0.05], [0.5, 0.2, 0.12])]}
    written("cell.json", json.dumps(scene))
    written("tool.json", json.dumps({"name": "gripper", "shapes": [
        {"sphere": {"radius": 0.02}, "pose": {"xyz": [0, 0, -0.05]}}]}))
    written("pick.csv", "motion,relative,x,y,z,roll,pitch,yaw,part\njoint,next,0,0,-0.1,0,0,0,\n"
                        "line,,0.5,0.2,0.15,180,0,0,\nattach,,,,,,,,part\nline,previous,0,0,-0.1,0,0,0,\n")
    given = ("export", "ur7e", "pick.csv", "--from", "0,-120,-80,110,-90,90", "--degrees", "--as", "urscript",
             "--out", "p.script")
    scened = ("--scene", "cell.json", "--tool-shape", "tool.json")
    answer = beeline(*given, *scened)
    assert answer.code == 0, answer.err
    from pathlib import Path
    assert "Attached: part from " in (tmp_path / "p.script").read_text()
    refused = beeline(*given)
    assert refused.code not in (0, 1) and "pick.csv:4: attach needs" in refused.err
