"""Programs: rows of --through with motion, relative, q, speed, blend, dwell."""

import csv
import math
from pathlib import Path

import pytest

PICK = Path(__file__).parents[2] / "examples" / "pick_panda.csv"
HOME = ("--from", "0,-45,0,-135,0,90,45", "--degrees")
HEAD = "motion,relative,x,y,z,roll,pitch,yaw,q,speed,blend,dwell\n"
ABOVE = "joint,,0.5,0.2,0.3,180,0,0,,,,\n"


def rows_of(path):
    with open(path) as file:
        return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]


@pytest.fixture
def picked(beeline, tmp_path):
    """picked(*options) -> the report of the example's pick, in move.csv."""

    def plan(*options):
        answer = beeline("line", "panda", *HOME, "--through", PICK, "--out", "move.csv", "--json",
                         *options)
        assert answer.code == 0, answer.err
        return answer.json

    return plan


@pytest.mark.parametrize("options", [(), ("--rate", "100"), ("--interpolation", "cubic"),
                                     ("--interpolation", "linear"), ("--profile", "fastest")])
def test_a_whole_pick_is_one_proved_trajectory(picked, beeline, tmp_path, matrix, options):
    report = picked(*options)
    rows = rows_of(tmp_path / "move.csv")
    joints = [f"joint{i}" for i in range(1, 8)]
    assert [move["motion"] for move in report["moves"]] == ["joint"] + 6 * ["line"]
    assert [move["place"] for move in report["moves"]] == [f"pick_panda.csv:{i}" for i in range(3, 10)]

    def tool(move):
        row = rows[report["moves"][move]["end"] - 1]
        m = matrix("panda", ",".join(repr(row[name]) for name in joints))
        return [m[3], m[7], m[11]]

    assert tool(0) == pytest.approx([0.5, 0.2, 0.27], abs=1e-6)  # 0.12 m above, along the tool
    assert tool(1) == pytest.approx([0.5, 0.2, 0.15], abs=1e-6)
    assert tool(5) == pytest.approx([0.4, -0.3, 0.2], abs=1e-6)
    assert tool(6) == pytest.approx([0.4, -0.3, 0.35], abs=1e-6)
    for move in (1, 5):
        planned = report["moves"][move]
        assert planned["dwell"] == pytest.approx(0.5, abs=2e-9)
        assert planned["tool_speed"] <= 0.1 * (1 + 1e-6)
        end, after = planned["end"] - 1, report["moves"][move + 1]["begin"] - 1
        for row in rows[end:after + 1]:
            assert [row[name] for name in joints] == [rows[end][name] for name in joints]
            assert all(row.get(name + "_vel", 0) == 0 for name in joints)
        assert after - end == (50 if "--rate" in options else 1)
    if "--rate" in options:
        assert all(row["t"] == round(k * 1e7) / 1e9 for k, row in enumerate(rows))
    answer = beeline("check", "panda", "move.csv", "--through", PICK, "--degrees", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["deviation_bound"] <= 1e-4
    assert len(answer.json["arrivals"]) == 7


def test_other_verbs_take_the_trajectory_of_a_program(picked, beeline, tmp_path):
    picked("--plot", "p.svg", "--draw", "d.svg")
    assert (tmp_path / "p.svg").stat().st_size > 1000 and (tmp_path / "d.svg").stat().st_size > 1000
    assert beeline("draw", "panda", "move.csv", "--out", "m.svg").code == 0
    for command in (("replay", "panda", "move.csv", "--speed", "0.5", "--out", "slow.csv"),
                    ("retime", "panda", "move.csv", "--out", "again.csv"),
                    ("diff", "panda", "move.csv", "move.csv"),
                    ("check", "panda", "move.csv", "--through", PICK, "--degrees", "--plot", "c.svg")):
        answer = beeline(*command)
        assert answer.code == 0, answer.err
    # A slower replay rests longer and keeps every speed; a retimed one has no dwells left.
    assert beeline("check", "panda", "slow.csv", "--through", PICK, "--degrees").code == 0
    again = beeline("check", "panda", "again.csv", "--through", PICK, "--degrees", "--json")
    assert again.code == 1 and again.json["fault"] in ("dwell", "tool_speed", "deviation")


def test_files_of_poses_keep_their_meaning(beeline, written, tmp_path):
    poses = "0.5,-0.2,0.5,180,0,0\n0.5,0.2,0.4,180,0,20\n0.4,0.1,0.5,180,0,0\n"
    written("poses.csv", "x,y,z,roll,pitch,yaw\n" + poses)
    lines = poses.splitlines()
    written("program.csv", "speed,x,y,z,roll,pitch,yaw\n" + "".join(f",{line}\n" for line in lines))
    for options in ((), ("--blend", "0.02"), ("--rate", "125")):
        made = [beeline("line", "panda", "--degrees", "--through", f"{name}.csv", "--out", f"{name}.out.csv",
                        "--json", *options) for name in ("poses", "program")]
        assert [answer.code for answer in made] == [0, 0], made[1].err
        first, second = (rows_of(tmp_path / f"{name}.out.csv") for name in ("poses", "program"))
        assert len(first) == len(second)
        for a, b in zip(first, second):
            assert list(a.values()) == pytest.approx(list(b.values()), abs=1e-9)


def test_joint_values_named_states_and_arcs(beeline, written, tmp_path):
    written("p.csv", "motion;q;x;y;z;roll;pitch;yaw\n"
                     "joint;0,-45,0,-135,0,90,45;;;;;;\n"
                     "joint;;0.5;0.1;0.4;180;0;0\n"
                     "via;;0.45;0.15;0.4;180;0;0\n"
                     "arc;;0.4;0.1;0.4;180;0;0\n"
                     "spline;;0.4;0;0.4;180;0;0\n"
                     "spline;;0.5;-0.1;0.35;180;0;10\n"
                     "screw;;0.5;-0.1;0.45;180;0;40\n"
                     "joint;0,-45,0,-135,0,90,45;;;;;;\n")
    report = beeline("line", "panda", "--degrees", "--through", "p.csv", "--out", "m.csv", "--json")
    assert report.code == 0, report.err
    motions = [move["motion"] for move in report.json["moves"]]
    assert motions == ["joint", "joint", "arc", "spline", "spline", "screw", "joint"]
    rows = rows_of(tmp_path / "m.csv")
    home = [math.radians(value) for value in (0, -45, 0, -135, 0, 90, 45)]
    for row in (rows[0], rows[-1]):
        assert [row[f"joint{i}"] for i in range(1, 8)] == pytest.approx(home, abs=1e-12)
    assert beeline("check", "panda", "m.csv", "--degrees", "--through", "p.csv").code == 0


def test_a_program_in_a_work_frame(picked, beeline, written, tmp_path):
    text = PICK.read_text()
    head, *rows = [line for line in text.splitlines() if not line.startswith("#")]
    moved = [head]
    for row in rows:
        items = row.split(",")
        if not items[1]:  # absolute: minus the work frame's origin
            items[2:5] = [repr(float(v) - d) for v, d in zip(items[2:5], (0.3, -0.1, 0.05))]
        moved.append(",".join(items))
    written("moved.csv", "\n".join(moved) + "\n")
    picked()
    answer = beeline("check", "panda", "move.csv", "--degrees", "--through", "moved.csv", "--work",
                     "0.3,-0.1,0.05")
    assert answer.code == 0, answer.err


@pytest.mark.parametrize("rows, line, says", [
    (ABOVE + "lin,,0.5,0.2,0.2,180,0,0,,,,\n", 3, ['unknown motion "lin"', "line"]),
    (ABOVE + "line,prev,0.5,0.2,0.2,180,0,0,,,,\n", 3, ['unknown relative "prev"', "previous"]),
    (ABOVE + "line,,0.5,0.2,,180,0,0,,,,\n", 3, ["column z"]),
    (ABOVE + "line,,,,,,,,,,,\n", 3, ["neither a pose nor"]),
    (ABOVE + 'line,,,,,,,,"0,0,0,-90,0,90,0",,,\n', 3, ["motion joint"]),
    (ABOVE + 'joint,,0.5,0.2,0.2,180,0,0,"0,0,0,-90,0,90,0",,,\n', 3, ["both a pose and"]),
    (ABOVE + 'joint,,,,,,,,"0,0",,,\n', 3, ["q", "7"]),
    (ABOVE + "joint,,,,,,,,home,,,\n", 3, ["--srdf"]),
    (ABOVE + 'joint,,,,,,,,"0,0,0,9,0,90,0",,,\n', 3, ["joint4", "limits"]),
    (ABOVE + "line,,0.5,0.2,0.2,180,0,0,,0,,\n", 3, ["speed must be at least 1e-08"]),
    (ABOVE + "line,,0.5,0.2,0.2,180,0,0,,,-1,\n", 3, ["blend must be 0"]),
    (ABOVE + "line,,0.5,0.2,0.2,180,0,0,,,,-1\n", 3, ["dwell must be"]),
    (ABOVE + "line,,0.5,0.2,0.2,180,0,0,,,0.1,\n", 3, ["a blend must be between lines"]),
    (ABOVE + "arc,,0.5,0.2,0.2,180,0,0,,,,\n", 3, ["motion via"]),
    (ABOVE + "via,,0.5,0.2,0.2,180,0,0,,,,\n", 3, ["followed by an arc"]),
    (ABOVE + "via,,0.5,0.2,0.2,180,0,0,,1,,\n", 3, ["via row has no speed"]),
    (ABOVE + "via,,0.5,0.2,0.25,180,0,0,,,,\narc,,0.5,0.2,0.2,180,0,0,,,,\n", 4, ["straight line"]),
    (ABOVE + "screw,,0.5,0.2,0.3,180,0,0,,,,\n", 3, ["same as the one before"]),
    ("line,next,0,0,0.1,0,0,0,,,,\n", 2, ["no row after"]),
    (ABOVE + "line,next,0,0,0.1,0,0,0,,,,\n", 3, ["no row after"]),
    (ABOVE + "line,,0.5,0.2\n", 3, ["4 items", "12"]),
    ("", 0, ["no rows"]),
])
def test_a_bad_row_is_refused_with_its_place(refused, written, rows, line, says):
    written("p.csv", HEAD + rows)
    place = f"p.csv:{line}: " if line else "p.csv: "
    refused(3, "line", "panda", *HOME, "--through", "p.csv", says=[place, *says])


def test_previous_in_the_first_row_is_the_start(beeline, written, tmp_path):
    written("p.csv", "motion,relative,x,y,z,roll,pitch,yaw\nspline,previous,0,0,-0.1,0,0,0\n"
                     "spline,previous,0.1,0,0,0,0,0\n")
    out = tmp_path / "m.csv"
    planned = beeline("line", "panda", *HOME, "--through", "p.csv", "--out", out, "--json")
    assert planned.code == 0, planned.err
    first = beeline("fk", "panda", "--q", HOME[1], "--degrees", "--json").json["pose"]["matrix"]
    end = ",".join(out.read_text().split()[-1].split(",")[1:8])
    last = beeline("fk", "panda", "--q=" + end, "--json").json["pose"]["matrix"]
    moved = [sum(first[r][c] * d for c, d in enumerate((0.1, 0, -0.1))) for r in range(3)]
    assert [last[r][3] - first[r][3] for r in range(3)] == pytest.approx(moved, abs=1e-6)
    assert beeline("check", "panda", out, "--through", "p.csv", "--degrees").code == 0
    refused = beeline("line", "panda", "--through", "p.csv")
    assert refused.code == 3 and "p.csv:2: " in refused.err and "no start is given" in refused.err


def test_unknown_columns_name_the_known_ones(refused, written):
    written("p.csv", "motion,x,y,z,roll,pitch,yaw,velocity\n")
    refused(3, "line", "panda", "--through", "p.csv", says=["p.csv:1: ", '"velocity"', "speed", "qw"])
    written("q.csv", "x,y,z,roll,pitch,yaw,motoin\n0,0,0,0,0,0,line\n")
    refused(3, "line", "panda", "--through", "q.csv", says=["q.csv:1: ", '"motoin"', "motion"])


def test_options_that_a_program_excludes(refused):
    line = ("line", "panda", *HOME, "--through", PICK)
    refused(2, *line, "--path", "spline", says=["--path", "column motion"])
    refused(2, *line, "--branches", says=["--branches", "program"])
    refused(2, *line, "--method", "inverse-jacobian", says=["--method", "program"])


def test_a_move_that_is_not_possible_is_named(beeline, written):
    written("p.csv", HEAD + ABOVE + "line,,0.5,0.2,0.1,180,0,0,,,,\nline,,1.5,0.2,0.1,180,0,0,,,,\n")
    answer = beeline("line", "panda", *HOME, "--through", "p.csv", "--out", "m.csv", "--json")
    assert answer.code == 1
    assert answer.json["failed_move"] == 3 and answer.json["failed_place"] == "p.csv:4"
    assert "move 3 (line, p.csv:4) stops after" in answer.err


def test_check_refuses_another_program(picked, beeline, written):
    picked()
    text = PICK.read_text()
    for change, fault in ((("line,,0.5,0.2,0.15", "line,,0.5,0.2,0.151"), "not_through"),
                          ((",0.1,,0.5\n", ",0.1,,0.6\n"), "dwell"),
                          (("0.1,,0.5", "0.05,,0.5"), "tool_speed"),
                          (("0.25,0.03", "0.25,0.02"), "deviation")):
        assert change[0] in text
        written("other.csv", text.replace(*change, 1))
        answer = beeline("check", "panda", "move.csv", "--through", "other.csv", "--degrees", "--json")
        assert (answer.code, answer.json["fault"]) == (1, fault), answer.err
        assert "pick" not in answer.err and "other.csv:" in answer.err


PASSING = HEAD + ("joint,next,0,0,-0.15,0,0,0,,,0.02,\nline,,0.5,0.2,0.15,180,0,20,,,,0.3\n"
                  "line,previous,0,0,-0.2,0,0,0,,,0.03,\njoint,,,,,,,,\"10,-20,0,-120,0,100,45\",,0.05,\n"
                  "joint,,,,,,,,\"-30,-30,0,-130,0,100,45\",,,\n")


@pytest.mark.parametrize("options", [(), ("--rate", "250"), ("--interpolation", "cubic")])
def test_joint_moves_and_lines_blend(beeline, written, tmp_path, options):
    written("p.csv", PASSING)
    written("stops.csv", PASSING.replace(",0.02,", ",,").replace(",0.03,", ",,").replace(",0.05,", ",,"))
    line = ("line", "panda", *HOME, "--through")
    answer = beeline(*line, "p.csv", "--out", "m.csv", "--json", *options)
    stops = beeline(*line, "stops.csv", "--out", "s.csv", "--json", *options)
    assert answer.code == stops.code == 0, answer.err
    assert answer.json["duration"] < stops.json["duration"]
    moves = answer.json["moves"]
    assert [move.get("blend") for move in moves] == ["full", None, "full", "full", None]
    assert all(move["joint_blend_radius"] > 0 for move in moves if "blend" in move)
    assert not any("blend" in move for move in stops.json["moves"])
    check = ("check", "panda", "--degrees", "--through")
    assert beeline(*check, "p.csv", "m.csv").code == 0 and beeline(*check, "p.csv", "s.csv").code == 0
    assert beeline(*check, "stops.csv", "m.csv").code == 1
    written("small.csv", PASSING.replace(",0.05,", ",0.005,"))
    refused = beeline(*check, "small.csv", "m.csv")
    assert refused.code == 1 and "the tool is off the waypoint of move 4 (joint, small.csv:5)" in refused.err
    assert "; its blend allows 0.005 m and 0.025 rad" in refused.err
    written("far.csv", PASSING.replace("10,-20,0,-120,0,100,45", "10,-20,0,-120,0,100,95"))
    far = beeline(*check, "far.csv", "m.csv", "--json").json
    assert far["fields"]["move"] == 4 and far["fields"]["joint"] == "joint7" and far["fields"]["limit"] == 0.05
    assert far["fields"]["angle_limit"] == 0.25 and "upper" not in far["fields"]
    assert 0.5 < far["fields"]["error"] < 1
    assert "and joint joint7 is 0." in beeline(*check, "far.csv", "m.csv").err


def test_blends_between_lines_are_reported(beeline, written):
    """The wrist of this arm cannot come nearer to its base than 2 m: the first blend would."""
    written("p.csv", "motion,x,y,theta,blend\nline,-2.7,1,0,\nline,0.5,2.35,0,0.9\nline,3.7,1,0,0.1\n"
                     "line,3.7,1,0,0.1\nline,3.7,0.2,0,\n")
    line = ("line", "RRR:3,1,0.5", "--through", "p.csv")
    answer = beeline(*line, "--out", "m.csv")
    assert answer.code == 0, answer.err
    assert "p.csv:3   smaller blend of " in answer.out and "p.csv:5   blend of " in answer.out and "blends  " not in answer.out
    report = beeline(*line, "--json").json
    assert [move.get("blend") for move in report["moves"]] == [None, "smaller", "full", "full", None]
    assert report["search_ending"] == "complete"
    check = beeline("check", "RRR:3,1,0.5", "m.csv", "--through", "p.csv")
    assert check.code == 0, check.err


@pytest.mark.parametrize("blend", ["0.9", "1e308"])
def test_one_sample_near_a_blended_waypoint_is_refused(beeline, written, tmp_path, blend):
    line = "line,-2.7,1,0,\nline,0.5,2.35,0,"
    written("p.csv", f"motion,x,y,theta,blend\n{line}0.9\nline,3.7,1,0,\n")
    assert beeline("line", "RRR:3,1,0.5", "--through", "p.csv", "--out", "m.csv").code == 0
    head, *rows = (tmp_path / "m.csv").read_text().splitlines()
    written("other.csv", f"motion,x,y,theta,blend\n{line}{blend}\nline,3.7,1,0,\n")
    for row in rows[::max(1, len(rows) // 20)]:
        written("one.csv", f"{head}\n{row}\n")
        assert beeline("check", "RRR:3,1,0.5", "one.csv", "--through", "other.csv").code == 1


def test_a_blend_that_becomes_a_stop_is_reported(beeline, written):
    there, back = "\"0,-45,0,-135,0,90,45\"", "\"20,-30,0,-120,0,90,45\""
    written("p.csv", HEAD + f"joint,,,,,,,,{back},,0.05,\njoint,,,,,,,,{there},,,\n")
    answer = beeline("line", "panda", *HOME, "--through", "p.csv")
    assert answer.code == 0 and "p.csv:2   stops in place of its blend\n" in answer.out
    report = beeline("line", "panda", *HOME, "--through", "p.csv", "--json").json
    assert report["moves"][0]["blend"] == "stop" and "blend" not in report["moves"][1]
