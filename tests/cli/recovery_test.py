"""--recover: motions that start slightly outside the position limits and lead back within them."""

import csv
import json

import pytest

UPPER = -0.0698  # of panda's joint4
OUTSIDE = "0,-0.8,0,-0.0688,0,1.6,0.8"
EXCESS = 0.001
TO = "0.5,0,0,-2,0,2,0"
QUICKEST = ["move", "panda", "--from", OUTSIDE, "--method", "quickest"]


@pytest.fixture
def through(written):
    return ["--through", written("through.csv", "0.2,-0.5,0,-1,0,1.6,0.8\n0.5,0,0,-2,0,2,0\n")]


@pytest.fixture
def line(beeline, written):
    """line panda from OUTSIDE to where joint4 is bent."""
    pose = beeline("fk", "panda", "--q", OUTSIDE.replace("-0.0688", "-0.2"), "--json").json["pose"]
    numbers = [*pose["translation"], *(pose["quaternion"][name] for name in ("qw", "qx", "qy", "qz"))]
    written("up.csv", "x,y,z,qw,qx,qy,qz\n" + ",".join(map(str, numbers)) + "\n")
    return ["line", "panda", "--from", OUTSIDE, "--through", "up.csv"]


def joint4(path):
    return [float(row["joint4"]) for row in csv.DictReader(path.open())]


def expect_recovery(section, samples):
    assert section["joint"] == "joint4"
    assert section["excess"] == pytest.approx(EXCESS, abs=1e-12)
    assert samples[0] == -0.0688
    back = samples[: section["sample"]]
    assert all(b <= a for a, b in zip(back, back[1:])) and len(back) > 1
    assert max(samples[section["sample"] - 1 :]) <= UPPER + 1e-9


def test_a_joint_move_leads_back_and_check_needs_the_option(beeline, refused, tmp_path):
    move = [*QUICKEST, "--to", TO, "--recover", "0.002", "--out", "move.csv"]
    answer = beeline(*move)
    assert answer.code == 0 and answer.err == ""
    assert "recovery      starts outside the limits by 0.001 rad, joint joint4; within them from " in answer.out
    expect_recovery(beeline(*move, "--json").json["recovery"], joint4(tmp_path / "move.csv"))
    without = beeline("check", "panda", "move.csv", "--json")
    assert without.code == 1 and without.json["fault"] == "limits" and without.json["recovery"] is None
    assert without.json["sample"] == 1
    assert beeline("check", "panda", "move.csv", "--recover", "0.0009").code == 1
    for amount in ("0.001", "0.1"):
        with_it = beeline("check", "panda", "move.csv", "--recover", amount)
        assert with_it.code == 0 and with_it.out.startswith("passed") and "recovery      starts" in with_it.out
    refused(2, *QUICKEST, "--to", TO, "--recover", "0.0009", says=["the motion cannot start", "joint4"])


def test_slight_is_a_fraction_of_the_smallest_range(beeline, tmp_path):
    slight = 1e-4 * (-0.0698 + 3.0718)  # joint4's is the smallest of panda's
    near = f"0,-0.8,0,{UPPER + 0.9 * slight},0,1.6,0.8"
    far = f"0,-0.8,0,{UPPER + 1.1 * slight},0,1.6,0.8"
    move = ["move", "panda", "--to", TO, "--method", "quickest", "--recover", "slight", "--out", "slight.csv"]
    assert beeline(*move, "--from", far).code == 2
    assert beeline(*move, "--from", near).code == 0
    assert beeline("check", "panda", "slight.csv", "--recover", "slight").code == 0
    assert beeline("check", "panda", "slight.csv", "--recover", str(slight / 2)).code == 1


def test_a_motion_through_configurations_leads_back_first(beeline, through, tmp_path):
    move = [*QUICKEST, *through, "--joint-blend", "0.1", "--out", "through_motion.csv", "--json"]
    assert beeline(*move).json["status"] == "outside_limits"
    answer = beeline(*move, "--recover", "0.002")
    assert answer.code == 0, answer.err
    expect_recovery(answer.json["recovery"], joint4(tmp_path / "through_motion.csv"))
    assert beeline("check", "panda", "through_motion.csv", "--recover", "0.002").code == 0
    assert beeline("check", "panda", "through_motion.csv").code == 1


def test_a_line_begins_where_the_joints_are_back(beeline, refused, line, tmp_path):
    refused(2, *line, says=["the motion cannot start", "joint4"])
    for options in ([], ["--rate", "200"], ["--duration", "3"]):
        answer = beeline(*line, "--recover", "0.002", "--out", "line.csv", *options, "--json")
        assert answer.code == 0, answer.err
        expect_recovery(answer.json["recovery"], joint4(tmp_path / "line.csv"))
        assert answer.json["deviation_bound"] < 1e-4
        if "--duration" in options:
            assert answer.json["duration"] == pytest.approx(3, abs=1e-9)
        checked = beeline("check", "panda", "line.csv", "--through", "up.csv", "--recover", "0.002", "--json")
        assert checked.code == 0, checked.json
        assert checked.json["recovery"] == answer.json["recovery"]
        assert checked.json["deviation_bound"] == pytest.approx(answer.json["deviation_bound"], rel=1e-3)
        assert beeline("check", "panda", "line.csv", "--through", "up.csv").code == 1


def test_a_program_begins_where_the_joints_are_back(beeline, refused, written, tmp_path):
    goal = "0,-0.8,0,-0.3,0,1.6,0.8"
    pose = beeline("fk", "panda", "--q", goal, "--json").json["pose"]
    numbers = [*pose["translation"], *(pose["quaternion"][name] for name in ("qw", "qx", "qy", "qz"))]
    at = ",".join(map(str, numbers))
    up = ",".join(map(str, [numbers[0], numbers[1], numbers[2] - 0.02, *numbers[3:]]))
    written("program.csv", f"motion,x,y,z,qw,qx,qy,qz\njoint,{at}\nline,{up}\n")
    follow = ["--through", "program.csv"]
    refused(2, "line", "panda", "--from", OUTSIDE, *follow, says=["the motion cannot start", "joint4"])
    for options in ([], ["--rate", "200"]):
        answer = beeline("line", "panda", "--from", OUTSIDE, *follow, *options, "--recover", "0.002", "--out", "p.csv", "--json")
        assert answer.code == 0, answer.err
        expect_recovery(answer.json["recovery"], joint4(tmp_path / "p.csv"))
        checked = beeline("check", "panda", "p.csv", *follow, "--recover", "0.002", "--json")
        assert checked.code == 0, checked.json
        assert checked.json["recovery"] == answer.json["recovery"]
        assert beeline("check", "panda", "p.csv", *follow).code == 1
    written("program.csv", "motion,x,y,z,qw,qx,qy,qz\nline,0.4,0.1,0.3,0,1,0,0\n")
    export = ["export", "ur5", "program.csv", "--as", "urscript", "--out", "p.script", "--self"]
    refused(2, *export, "--recover", "0.002", says=["--recover is", "trajectories"])
    refused(2, *export, "--recover-clearance", "0.002", says=["--recover-clearance is", "trajectories"])


def test_a_collision_at_the_start_is_refused_at_the_start(beeline, written):
    scene = {"obstacles": [{"name": "box", "shapes": [{"box": {"size": [0.3, 0.3, 0.3]}, "pose": {"xyz": [0.4, 0, 0.5]}}]}]}
    cell = ["--scene", written("box.json", json.dumps(scene))]
    start = "0,-0.3,0,-2.2,0,1.9,0.8"
    answer = beeline("move", "panda", "--from", start, "--to", "1" + start[1:], "--method", "quickest", *cell, "--json")
    assert answer.code == 1 and answer.json["status"] == "collides" and answer.json["fields"]["time"] == 0


def test_durations_count_from_the_first_sample(beeline, written):
    written("late.csv", "t,joint1,joint2,joint3\n100,0,1,0\n101,0.1,1,0\n102,0.1,1,0\n")
    assert beeline("check", "rrr", "late.csv", "--json").json["duration"] == 2


def test_slow_lines_reach_their_speed(beeline, written):
    written("seam.csv", "x,y,z,roll,pitch,yaw\n0.5,-0.2,0.5,180,0,0\n0.5,0.2,0.5,180,0,0\n")
    for speed in (0.2, 0.02, 0.002):
        line = ["line", "kr6_r900", "--tcp", "0,0,0.1", "--degrees", "--through", "seam.csv", "--tool-speed", str(speed)]
        answer = beeline(*line, "--json")
        assert answer.code == 0, answer.err
        assert 0.4 / speed <= answer.json["duration"] <= 1.01 * 0.4 / speed + 0.2


def test_blends_that_are_stops_are_said(beeline, written):
    rows = ["0.5,-0.2,0.4,180,0,0", "0.5,0.2,0.4,180,0,0", "0.5,-0.1,0.4,180,0,0", "0.4,-0.1,0.4,180,0,0"]
    written("back.csv", "x,y,z,roll,pitch,yaw\n" + "\n".join(rows) + "\n")
    answer = beeline("line", "panda", "--degrees", "--through", "back.csv", "--blend", "0.05")
    assert answer.code == 0 and "turns back at waypoint 2, where no blend is possible: it stops" in answer.err
    assert "waypoint 3" not in answer.err


def test_an_excess_that_rises_is_refused(beeline, tmp_path):
    beeline(*QUICKEST, "--to", TO, "--recover", "0.002", "--rate", "1000", "--out", "move.csv")
    rows = list(csv.DictReader((tmp_path / "move.csv").open()))
    with (tmp_path / "out.csv").open("w") as file:  # positions alone: joint4 moves out first
        names = ["t", *(f"joint{k}" for k in range(1, 8))]
        writer = csv.DictWriter(file, names, extrasaction="ignore")
        writer.writeheader()
        for k, row in enumerate(rows):
            writer.writerow({**row, "joint4": -0.0688 + 1e-7 if k == 1 else row["joint4"]})
    answer = beeline("check", "panda", "out.csv", "--recover", "0.01", "--json")
    assert answer.code == 1 and answer.json["code"] == "excess_rises"
    assert answer.json["fields"]["change"] == pytest.approx(1e-7, rel=1e-3)
    assert "does not return steadily" in answer.json["reason"]


def test_exported_files_say_so(beeline, tmp_path):
    beeline(*QUICKEST, "--to", TO, "--recover", "0.002", "--out", "move.csv")
    export = ["export", "panda", "move.csv", "--as", "ros2", "--out", "move.yaml"]
    assert beeline(*export, "--json").json["status"] == "outside_limits"
    answer = beeline(*export, "--recover", "0.002", "--json")
    assert answer.code == 0, answer.err
    remark = "limits of position: joint joint4 starts outside its limits by 0.001"
    assert any(text.startswith(remark) for text in answer.json["not_proved"])
    assert "position" not in answer.json["proof"].split(" at all times")[0]
    assert remark in " ".join((tmp_path / "move.yaml").read_text().replace("\n#", "").split())
    assert beeline("check", "panda", "move.yaml", "--recover", "0.002").code == 0


@pytest.mark.parametrize("amount", ["nan", "inf", "-0.001", "1e300", "0.2", "abc", "", "1e999"])
def test_amounts_that_make_no_sense_are_refused(beeline, line, amount, tmp_path):
    beeline(*QUICKEST, "--to", TO, "--recover", "0.002", "--out", "move.csv")
    for command in ([*QUICKEST, "--to", TO], line, ["check", "panda", "move.csv"], ["retime", "panda", "move.csv"]):
        answer = beeline(*command, f"--recover={amount}")
        assert answer.code == 2 and answer.out == "", answer.err
        assert answer.err.startswith("beeline: --recover") and answer.err.count("\n") == 1, answer.err


def test_it_belongs_to_methods_and_to_paths(refused, written):
    refused(2, "move", "panda", "--from", OUTSIDE, "--to", TO, "--recover", "0.01", says=["--recover", "--method"])
    program = written("program.csv", "x,y,z,roll,pitch,yaw,motion\n0.5,-0.1,0.5,180,0,0,line\n")
    refused(2, "line", "panda", "--through", program, "--recover", "0.01", says=["--recover", "--from"])


def test_degrees_count_for_the_amount_too(beeline, refused, tmp_path):
    degrees = "0,-45.8,0,-3.942,0,91.7,45.8"  # joint4's limit is -3.99925 deg
    move = ["move", "panda", "--degrees", "--from", degrees, "--to", "28,0,0,-114,0,114,0", "--method", "quickest"]
    answer = beeline(*move, "--recover", "0.06", "--out", "degrees.csv")
    assert answer.code == 0, answer.err
    assert beeline("check", "panda", "degrees.csv", "--degrees", "--recover", "0.06").code == 0
    assert beeline("check", "panda", "degrees.csv", "--degrees", "--recover", "0.05").code == 1
    refused(2, *move, "--recover", "0.05", says=["the motion cannot start", "joint4"])
    refused(2, *move, "--recover", "6", says=["recover must be from 0 to 0.1"])  # 0.105 rad
