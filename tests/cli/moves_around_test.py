"""Programs with the motion around: examples/pick_cell.csv in its cell."""

import csv
import math
import re
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
TOOL = ("--tcp", "0,0,0.15", "--tool-shape", EXAMPLES / "suction_gripper.json", "--degrees")
HOME = ("--from", "0,-45,0,-135,0,90,45")
UR5E_HOME = ("--from", "30,-90,90,-90,-90,0")


@pytest.fixture
def cell(beeline, tmp_path):
    """cell(verb, arm, *options) -> the answer in the example's cell, in which the base of the arm stands on the table."""
    def ask(verb, arm, *options, base="panda_link0"):
        scene = (EXAMPLES / "pick_cell.json").read_text().replace("panda_link0", base)
        (tmp_path / "scene.json").write_text(scene)
        return beeline(verb, arm, *options, *TOOL, "--scene", "scene.json")

    return ask


@pytest.mark.parametrize("options", [(), ("--rate", "250"), ("--interpolation", "linear")])
def test_a_pick_goes_around_a_partition(cell, options):
    through = ("--through", EXAMPLES / "pick_cell.csv")
    planned = cell("line", "panda", *HOME, *through, *options, "--out", "motion.csv", "--json")
    assert planned.code == 0, planned.err
    motions = [move["motion"] for move in planned.json["moves"]]
    assert motions == ["around", "line", "line", "around", "line", "line", "around"]
    assert planned.json["clearance"]["status"] == "clear"
    # Not around the arm's own base, and not at the limits of its joints.
    assert planned.json["duration"] < 8 and planned.json["limit_margin"] > 0.1
    checked = cell("check", "panda", "motion.csv", *through)
    assert checked.code == 0, checked.err


def test_the_straight_joint_motions_are_not_free(cell, tmp_path):
    rows = (EXAMPLES / "pick_cell.csv").read_text().replace("\naround,", "\njoint,")
    (tmp_path / "straight.csv").write_text(rows)
    answer = cell("line", "panda", *HOME, "--through", "straight.csv")
    assert answer.code == 1 and "part" in answer.err and "straight.csv:7" in answer.err


def test_a_controller_gets_joint_moves_to_the_waypoints(cell, tmp_path):
    answer = cell("export", "ur5e", EXAMPLES / "pick_cell.csv", *UR5E_HOME, "--as", "urscript", "--out", "pick.script",
                  base="fixed_base_link")
    assert answer.code == 0, answer.err
    moves = [line.split("(")[0].strip() for line in (tmp_path / "pick.script").read_text().splitlines()
             if re.match(r"\s*move[jl]\((?!first)", line)]
    first = moves.index("movel")
    assert moves.count("movel") == 4 and first >= 1
    around = moves[first + 2:moves.index("movel", first + 2)]  # from the second line up to the third
    assert set(around) == {"movej"} and len(around) > 1


@pytest.mark.parametrize("form", ["urscript", "rapid", "krl"])
def test_the_speed_of_a_row_holds_on_a_controller(beeline, cell, tmp_path, form):
    slow = re.sub(r"(?m)^(around,next,0,0,-0.12,0,0,0,),", r"\g<1>0.1,", (EXAMPLES / "pick_cell.csv").read_text())
    assert slow != (EXAMPLES / "pick_cell.csv").read_text()
    (tmp_path / "slow.csv").write_text(slow)
    file = f"pick.{dict(urscript='script', rapid='mod', krl='src')[form]}"
    answer = cell("export", "ur5e", "slow.csv", *UR5E_HOME, "--as", form, "--out", file, base="fixed_base_link")
    assert answer.code == 0, answer.err
    if form != "urscript":
        return
    program = (tmp_path / file).read_text()
    speeds = [float(v) for v in re.findall(r"movej\(\[.*\], a=.*, v=(.*)\)", program)]
    targets = [[float(x) for x in row.split(",")] for row in re.findall(r"movej\(\[(.*)\], a=", program)]
    slow_legs = 0
    for before, after, speed in zip(targets, targets[1:], speeds[1:]):
        leading = max(abs(b - a) for a, b in zip(before, after))
        steps = [",".join(repr(a + k / 8 * (b - a)) for a, b in zip(before, after)) for k in range(9)]
        tools = [beeline("fk", "ur5e", "--tcp", "0,0,0.15", "--q=" + q, "--json").json["pose"]["translation"] for q in steps]
        fastest = max(math.dist(a, b) for a, b in zip(tools, tools[1:])) * 8 / leading * speed
        slow_legs += fastest < 0.1 + 1e-3
    assert slow_legs >= 2


def test_joint_values_of_a_move_around(cell, tmp_path):
    (tmp_path / "q.csv").write_text('motion,q\naround,"10,-45,0,-135,0,90,45"\n')
    answer = cell("line", "panda", *HOME, "--through", "q.csv", "--json")
    assert answer.code == 0 and answer.json["limit_margin"] is None, answer.err


def test_a_line_that_is_blocked_is_named(cell, tmp_path):
    (tmp_path / "blocked.csv").write_text(
        "motion,x,y,z,roll,pitch,yaw\naround,0.6,0.25,0.2,180,0,0\nline,0.6,-0.25,0.2,180,0,0\n")
    answer = cell("line", "panda", *HOME, "--through", "blocked.csv", "--json")
    assert answer.code == 1 and answer.json["status"] == "collides" and answer.json["failed_move"] == 2
    assert "partition" in answer.err


def test_obstacles_are_asked_for(beeline, cell, tmp_path):
    rows = list(csv.reader((EXAMPLES / "pick_cell.csv").read_text().splitlines()))
    kept = [row for row in rows if row[0] not in ("attach", "detach")]
    with open(tmp_path / "moves.csv", "w", newline="") as file:
        csv.writer(file).writerows(kept)
    answer = beeline("line", "panda", *HOME, *TOOL[:2], "--degrees", "--through", "moves.csv")
    assert answer.code not in (0, 1) and "moves.csv:3: around needs the obstacles" in answer.err
    assert beeline("line", "panda", *HOME, *TOOL, "--self", "--through", "moves.csv").code == 0
    (tmp_path / "blend.csv").write_text("motion,x,y,z,roll,pitch,yaw,blend\naround,0.5,0.3,0.2,180,0,0,0.01\n,0.5,0.2,0.2,180,0,0,\n")
    answer = cell("line", "panda", *HOME, "--through", "blend.csv")
    assert answer.code not in (0, 1) and "blend.csv:2" in answer.err and "between lines" in answer.err
