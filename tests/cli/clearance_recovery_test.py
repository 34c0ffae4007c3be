"""--recover-clearance: motions that start closer to an obstacle than the clearance, or in contact, and lead out."""

import csv
import json

import pytest


@pytest.fixture
def cell(written):
    """A disc of radius 0.2 m on two slides, above a table whose top is at y = 0, with a post at x = 0.7."""
    limits = {"lower": -2, "upper": 2, "velocity": 1, "acceleration": 4}
    slides = [{"name": name, "type": "prismatic", "axis": axis, "limits": limits}
              for name, axis in (("x", [1, 0, 0]), ("y", [0, 1, 0]))]
    shapes = [{"name": "disc", "joint": "y", "shapes": [{"sphere": {"radius": 0.2}}]}]
    written("disc.json", json.dumps({"name": "disc", "joints": slides, "shapes": shapes}))
    written("cell.json", json.dumps({"obstacles": [
        {"name": "table", "shapes": [{"box": {"size": [4, 1, 4]}, "pose": {"xyz": [0, -0.5, 0]}}]},
        {"name": "post", "shapes": [{"box": {"size": [0.2, 0.6, 1]}, "pose": {"xyz": [0.7, 0.3, 0]}}]}]}))
    return ["--scene", "cell.json", "--clearance", "0.005"]


def move(beeline, cell, method, start, goal, *more):
    return beeline("move", "disc.json", f"--from={start}", f"--to={goal}", "--method", method, *cell, "--out", "out.csv", *more)


def heights(path):
    return [float(row["y"]) for row in csv.DictReader(path.open())]


@pytest.mark.parametrize("method", ["quickest", "around"])
@pytest.mark.parametrize("distance", [0.003, -0.001])
def test_a_move_leads_out_and_check_needs_the_option(beeline, cell, tmp_path, method, distance):
    depth = 0.005 - distance
    start, goal = f"0,{0.2 + distance}", "-0.5,0.5" if method == "quickest" else "1.5,0.5"
    refused = move(beeline, cell, method, start, goal)
    assert refused.code == 1 and not (tmp_path / "out.csv").exists()
    says = f"at the start, disc and table are {depth:g} m closer than the clearance; --recover-clearance {depth:g} accepts"
    assert says in refused.err
    answer = move(beeline, cell, method, start, goal, "--recover-clearance", f"{depth:g}", "--json")
    assert answer.code == 0, answer.err
    recovery = answer.json["clearance"]["recovery"]
    assert recovery["pair"] == ["disc", "table"] and recovery["pairs"] == 1
    assert recovery["depth"] == pytest.approx(depth, abs=1e-9)
    assert recovery["distance"] == pytest.approx(distance, abs=1e-9)
    section = heights(tmp_path / "out.csv")[: recovery["sample"]]
    assert all(a <= b + 1e-12 for a, b in zip(section, section[1:]))
    assert section[-2] < 0.205 + 1e-3 and min(heights(tmp_path / "out.csv")[recovery["sample"] - 1 :]) >= 0.205
    check = ["check", "disc.json", "out.csv", *cell]
    without = beeline(*check)
    assert without.code == 1 and without.out.startswith("collides") and says in without.err
    too_little = beeline(*check, "--recover-clearance", f"{0.9 * depth:g}")
    assert too_little.code == 1 and says in too_little.err
    for amount in (f"{depth:g}", "0.1"):
        passed = beeline(*check, "--recover-clearance", amount)
        assert passed.code == 0 and passed.out.startswith("passed"), passed.err
        assert f"recovery      starts {depth:g} m closer than the clearance, disc and table; out of it from " in passed.out
        assert f"clearance     kept from {recovery['time']:g} s on, proved" in passed.out
    again = beeline(*check, "--recover-clearance", "0.1", "--json").json["clearance"]
    assert again["recovery"] == recovery
    assert beeline(*check, "--json").json["clearance"]["recovery"] is None


def test_the_text_of_a_move_says_where_the_recovery_ends(beeline, cell):
    answer = move(beeline, cell, "around", "0,0.203", "1.5,0.5", "--recover-clearance", "0.002")
    assert answer.code == 0, answer.err
    again = move(beeline, cell, "around", "0,0.203", "1.5,0.5", "--recover-clearance", "0.002", "--json").json
    assert again["tool_at_goal"]["translation"] == pytest.approx([1.5, 0.5, 0])
    assert "recovery      starts 0.002 m closer than the clearance, disc and table; out of it from " in answer.out


def test_a_motion_through_configurations_leads_out(beeline, cell, written):
    written("through.csv", "0,0.3\n-0.5,0.5\n")
    through = ["move", "disc.json", "--from=0,0.203", "--through", "through.csv", "--method", "quickest", *cell]
    assert "--recover-clearance 0.002 accepts" in beeline(*through).err
    answer = beeline(*through, "--recover-clearance", "0.002", "--plot", "plot.svg", "--json")
    assert answer.code == 0 and answer.json["clearance"]["recovery"]["depth"] == pytest.approx(0.002, abs=1e-9), answer.err


def test_a_line_leads_out(beeline, cell, tmp_path, written):
    written("up.csv", "x,y,z\n-0.3,0.5,0\n-0.5,0.5,0\n")
    line = ["line", "disc.json", "--from=0,0.203", "--through", "up.csv", "--task", "position", *cell, "--out", "line.csv"]
    refused = beeline(*line)
    assert refused.code == 1 and not (tmp_path / "line.csv").exists()
    assert "disc and table are 0.002 m closer than the clearance; --recover-clearance 0.002 accepts" in refused.err
    assert beeline(*line, "--recover-clearance", "0.001").code == 1
    answer = beeline(*line, "--recover-clearance", "0.002", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["clearance"]["recovery"]["pair"] == ["disc", "table"]
    check = ["check", "disc.json", "line.csv", "--through", "up.csv", "--task", "position", *cell]
    assert beeline(*check).code == 1 and beeline(*check, "--recover-clearance", "0.002").code == 0
    written("down.csv", "x,y,z\n0,0.2025,0\n0,0.5,0\n")
    down = beeline(*[word.replace("up.csv", "down.csv") for word in line], "--recover-clearance", "0.01")
    assert down.code == 1 and "the motion must lead out of it" in down.err


def test_a_start_at_the_clearance_is_accepted_as_suggested(beeline, cell, written):
    written("up.csv", "x,y,z\n0,0.5,0\n")
    for y in ("0.205", "0.204999999"):
        line = ["line", "disc.json", f"--from=0,{y}", "--through", "up.csv", "--task", "position", *cell]
        refused = beeline(*line)
        assert refused.code == 1 and "; --recover-clearance 1e-09 accepts a motion that leads out" in refused.err, refused.err
        assert beeline(*line, "--recover-clearance", "1e-09").code == 0


def test_no_start_is_chosen_that_is_too_close(beeline, cell, written):
    written("up.csv", "x,y,z\n0,0.203,0\n0,0.5,0\n")
    line = ["line", "disc.json", "--through", "up.csv", "--task", "position", *cell]
    assert "recover-clearance" not in beeline(*line).err
    answer = beeline(*line, "--recover-clearance", "0.01")
    assert answer.code == 2 and "--recover-clearance needs --from" in answer.err


def test_the_start_is_from_with_recover_too(beeline, cell, tmp_path, written):
    arm = json.loads((tmp_path / "disc.json").read_text())
    arm["joints"][1]["limits"]["lower"] = 0.204
    written("low.json", json.dumps(arm))
    written("up.csv", "x,y,z\n0,0.5,0\n")
    line = ["line", "low.json", "--through", "up.csv", "--task", "position", *cell, "--from=0,0.203", "--recover", "0.1"]
    assert "disc and table are 0.002 m closer than the clearance; --recover-clearance 0.002 accepts" in beeline(*line).err
    answer = beeline(*line, "--recover-clearance", "0.002")
    assert answer.code == 0, answer.err


def test_the_limit_of_work_is_no_matter_of_the_start(beeline, cell, written):
    written("up.csv", "x,y,z\n0,0.5,0\n")
    line = ["line", "disc.json", "--through", "up.csv", "--task", "position", *cell, "--from=0,0.203", "--recover-clearance", "0.01"]
    codes = set()
    for work in (1, 4, 16, 64, 256, 1024, 100000):
        answer = beeline(*line, "--max-work", str(work), "--json")
        codes.add(answer.code)
        assert answer.code == 0 or answer.json["status"] == "work_limit" and "must lead out" not in answer.err, answer.err
    assert codes == {0, 1}


def test_a_program_leads_out(beeline, cell, written):
    written("program.csv", "motion,x,y,z\nline,0,0.5,0\nline,0.2,0.5,0\n")
    follow = ["--through", "program.csv", "--task", "position", *cell]
    line = ["line", "disc.json", "--from=0,0.203", *follow, "--out", "out.csv", "--json"]
    refused = beeline(*line)
    assert refused.code == 1 and "--recover-clearance 0.002 accepts" in refused.err, refused.err
    answer = beeline(*line, "--recover-clearance", "0.002")
    assert answer.code == 0, answer.err
    recovery = answer.json["clearance"]["recovery"]
    assert recovery["depth"] == pytest.approx(0.002, abs=1e-9) and 0 < recovery["time"] < answer.json["duration"]
    check = ["check", "disc.json", "out.csv", *follow, "--json"]
    assert beeline(*check).json["clearance"]["status"] == "collides"
    assert beeline(*check, "--recover-clearance", "0.001").code == 1
    checked = beeline(*check, "--recover-clearance", "0.002")
    assert checked.code == 0 and checked.json["clearance"]["recovery"] == recovery
    # Towards the table it leads nowhere.
    written("program.csv", "motion,x,y,z\nline,0,0.2025,0\nline,0.2,0.5,0\n")
    assert beeline(*line, "--recover-clearance", "0.002").code == 1


def test_feedback_leads_out(beeline, cell):
    assert "--recover-clearance 0.002 accepts" in move(beeline, cell, "feedback", "0,0.203", "-0.5,0.5").err
    answer = move(beeline, cell, "feedback", "0,0.203", "-0.5,0.5", "--recover-clearance", "0.002", "--json")
    assert answer.code == 0 and answer.json["clearance"]["recovery"]["depth"] == pytest.approx(0.002, abs=1e-9), answer.err


@pytest.mark.parametrize("verb", ["retime", "replay", "export"])
def test_what_is_made_of_a_motion_that_leads_out_does_too(beeline, cell, tmp_path, verb):
    assert move(beeline, cell, "quickest", "0,0.203", "-0.5,0.5", "--recover-clearance", "0.002").code == 0
    made = tmp_path / ("made.yaml" if verb == "export" else "made.csv")
    make = [verb, "disc.json", "out.csv", *cell, "--out", made.name, *(["--as", "ros2"] if verb == "export" else [])]
    refused = beeline(*make)
    assert refused.code == 1 and not made.exists()
    assert "--recover-clearance 0.002 accepts" in refused.err
    answer = beeline(*make, "--recover-clearance", "0.002", "--json")
    assert answer.code == 0 and answer.json["clearance"]["recovery"]["depth"] == pytest.approx(0.002, abs=1e-9), answer.err
    time = answer.json["clearance"]["recovery"]["time"]
    if verb == "export":
        text = made.read_text()
        assert f"proved from {time:g} s on" in text and "# Recovery: starts 0.002 m closer than the clearance" in text
    assert beeline("check", "disc.json", made.name, *cell, "--recover-clearance", "0.002").code == 0


def test_a_motion_that_comes_closer_first_is_refused(beeline, cell, written):
    written("down.csv", "t,x,y\n0,0,0.203\n1,0,0.2029\n2,0,0.5\n3,0,0.5\n")
    answer = beeline("check", "disc.json", "down.csv", *cell, "--recover-clearance", "0.01", "--moving-start")
    assert answer.code == 1
    assert "the motion must lead out of it, and no pair may come closer before" in answer.err
    still = move(beeline, cell, "quickest", "0,0.203", "0.2,0.203", "--recover-clearance", "0.01")
    assert still.code == 1 and "the motion must lead out of it" in still.err


def test_a_start_that_is_clear_needs_no_recovery(beeline, cell):
    for option in ([], ["--recover-clearance", "0.01"]):
        answer = move(beeline, cell, "quickest", "0,0.3", "0,0.5", "--json", *option)
        assert answer.code == 0 and answer.json["clearance"]["recovery"] is None


def test_a_start_too_deep_says_so(beeline, cell):
    answer = move(beeline, cell, "around", "0,0.05", "0,0.5", "--recover-clearance", "0.1")
    assert answer.code == 1 and "are 0.155 m closer than the clearance, more than the 0.1 m from which" in answer.err


def test_hostile_values_and_places(beeline, refused, cell, written):
    start = ["move", "disc.json", "--from=0,0.203", "--to=0,0.5"]
    for value in ("-1", "-1e-300", "0.11", "1e308", "nan", "inf", "x", "", "slight"):
        refused(2, *start, "--method", "quickest", *cell, "--recover-clearance", value, says=["--recover-clearance"])
    refused(2, *start, "--method", "quickest", "--recover-clearance", "0.01", says=["--recover-clearance needs --scene"])
    zero = move(beeline, cell, "quickest", "0,0.203", "0,0.5", "--recover-clearance", "0")
    assert zero.code == 1 and "--recover-clearance 0.002" in zero.err
