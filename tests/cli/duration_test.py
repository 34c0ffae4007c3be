"""Motions of a given duration, starts slightly outside the limits, limits with a tolerance."""

import csv
import math
import re

import pytest

FROM, TO = "0,-0.8,0,-2.4,0,1.6,0.8", "0.5,0,0,-2,0,2,0"
MOVE = ["move", "panda", "--from", FROM, "--to", TO, "--method", "quickest"]


@pytest.fixture
def line(written):
    written("far.csv", "x,y,z,roll,pitch,yaw\n0.5,-0.1,0.5,180,0,0\n0.5,0.2,0.4,180,0,20\n")
    return ["line", "panda", "--through", "far.csv", "--degrees"]


def test_each_verb_keeps_a_duration_exactly(beeline, line, tmp_path):
    beeline(*MOVE, "--out", "move.csv")
    for command in (MOVE, line, ["retime", "panda", "move.csv"]):
        quickest = beeline(*command, "--json").json["duration"]
        for seconds in (math.ceil(quickest), math.ceil(3 * quickest)):
            slow = beeline(*command, "--duration", str(seconds), "--out", "slow.csv", "--json")
            assert slow.code == 0 and slow.json["duration"] == pytest.approx(seconds, abs=1e-9)
            rows = list(csv.DictReader((tmp_path / "slow.csv").open()))
            assert float(rows[-1]["t"]) == pytest.approx(seconds, abs=1e-9)
        if command is line:
            checked = beeline("check", "panda", "slow.csv", "--through", "far.csv", "--degrees")
            assert checked.out.startswith("passed"), checked.out + checked.err


def test_a_duration_that_is_too_short_is_refused_with_the_shortest(beeline, line):
    beeline(*MOVE, "--out", "move.csv")
    for command in (MOVE, line, ["retime", "panda", "move.csv"]):
        quickest = beeline(*command, "--json").json["duration"]
        short = beeline(*command, "--duration", "0.1", "--json")
        assert short.code == 1 and short.json["status"] == "outside_limits"
        shortest = re.search(r"the shortest within the limits is ([0-9.]+) s", short.err)[1]
        assert quickest <= float(shortest) <= quickest + 1e-4
        if command is not MOVE:  # whole periods
            assert beeline(*command, "--duration", shortest).code == 0


def test_durations_that_cannot_be_combined(refused, line, written):
    refused(2, *line, "--duration", "9", "--rate", "100", says=["--duration cannot be combined with --rate"])
    refused(2, *line, "--duration", "0", says=["--duration must be above 0"])
    refused(2, *MOVE, "--duration", "2.005", says=["--duration", "2 or 2.01 s"])
    refused(2, *[word if word != "quickest" else "feedback" for word in MOVE], "--duration", "2",
            says=["--duration", "--method quickest"])
    written("program.csv", "x,y,z,roll,pitch,yaw,motion\n0.5,-0.1,0.5,180,0,0,line\n0.5,0.2,0.4,180,0,20,line\n")
    refused(2, "line", "panda", "--through", "program.csv", "--degrees", "--duration", "9",
            says=["--duration", "program.csv is a program"])


def test_a_start_slightly_outside_leads_back_in(beeline, refused, tmp_path):
    outside = "0,-0.8,0,-0.03,0,1.6,0.8"  # joint4 ends at -0.0698
    move = ["move", "panda", "--to", TO, "--method", "quickest", "--out", "in.csv"]
    answer = beeline(*move, "--from", outside)
    assert answer.code == 0 and "joint4" in answer.err and "leads back in" in answer.err
    joint4 = [float(row["joint4"]) for row in csv.DictReader((tmp_path / "in.csv").open())]
    assert joint4[0] == -0.03 and all(b <= a + 1e-12 for a, b in zip(joint4, joint4[1:])) and joint4[-1] == -2
    refused(2, *move, "--from", "0,-0.8,0,0.5,0,1.6,0.8", says=["the motion cannot start", "joint4"])
    stays = beeline("move", "panda", "--from", FROM, "--to", outside, "--method", "quickest")
    assert stays.code == 1 and "the goal is outside the limits" in stays.err


def test_a_tolerance_on_limits_is_for_rounding_and_is_reported(beeline, line, tmp_path):
    beeline(*line, "--out", "move.csv")
    rows = list(csv.DictReader((tmp_path / "move.csv").open()))
    scale = 1.00005
    with (tmp_path / "rounded.csv").open("w") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        for row in rows:
            power = {name: 1 if name.endswith("_vel") else 2 if name.endswith("_acc") else 0 for name in row}
            writer.writerow({name: float(text) * scale ** power[name] / (scale if name == "t" else 1)
                             for name, text in row.items()})
    check = ["check", "panda", "rounded.csv", "--through", "far.csv", "--degrees"]
    refused = beeline(*check)
    assert refused.code == 1
    value, limit = re.search(r"(?:reaches|needs) ([0-9.]+) .*its limit is ([0-9.]+)", refused.err).groups()
    assert float(value) > float(limit) and value != limit
    passed = beeline(*check, "--limit-tolerance", "1e-3")
    assert passed.code == 0 and "tolerance     0.1 % of the limits" in passed.out
    assert beeline(*check, "--limit-tolerance", "1e-3", "--json").json["limit_tolerance"] == 1e-3
    assert beeline(*check, "--limit-tolerance", "1e-5").code == 1
    assert beeline(*check, "--limit-tolerance", "0.2").code == 2
    played = beeline("replay", "panda", "rounded.csv", "--limit-tolerance", "1e-3", "--json")
    assert played.code == 0 and played.json["limit_tolerance"] == 1e-3 and not played.err
