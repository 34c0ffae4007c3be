"""--rate: the same lowest rate for every verb, --max-samples with it, and budgets while samples are made."""

import csv

import pytest

POSES = "x,y,z,roll,pitch,yaw\n0.5,-0.2,0.5,180,0,0\n0.5,0.2,0.4,180,0,20\n0.4,0.1,0.5,180,0,0\n"
PANDA = "0,-0.8,0,-2.4,0,1.6,0.8"
QUICKEST = ("move", "panda", "--from", PANDA, "--to", "0.5,0,0,-2,0,2,0", "--method", "quickest")
LINE = ("line", "panda", "--degrees", "--through", "poses.csv")


@pytest.fixture
def files(beeline, written):
    written("poses.csv", POSES)
    assert beeline(*QUICKEST, "--out", "move.csv").code == 0


@pytest.mark.parametrize("rate", ["1e-300", "0.0009", "0"])
def test_every_verb_has_the_same_lowest_rate(refused, files, rate):
    for verb in (QUICKEST, LINE, ("retime", "panda", "move.csv"), ("replay", "panda", "move.csv"),
                 ("export", "panda", "move.csv", "--as", "csv", "--out", "a.csv")):
        refused(2, *verb, "--rate", rate, says=["--rate must be at least 0.001", rate])


def test_an_export_at_a_low_rate_holds_the_first_and_the_last_sample(beeline, files, tmp_path):
    answer = beeline("export", "panda", "move.csv", "--as", "csv", "--rate", "0.001", "--out", "low.csv")
    assert answer.code == 0, answer.err
    rows = lambda path: [row for row in csv.DictReader(
        line for line in (tmp_path / path).open() if not line.startswith("#"))]
    low, whole = rows("low.csv"), rows("move.csv")
    assert [float(row["t"]) for row in low] == [0, 1000]
    for joint in ("joint1", "joint7"):
        assert [float(row[joint]) for row in low] == [float(whole[0][joint]), float(whole[-1][joint])]


@pytest.mark.parametrize("verb", [LINE, ("retime", "panda", "move.csv")])
def test_max_samples_holds_with_a_rate(beeline, files, verb):
    answer = beeline(*verb, "--rate", "1000", "--max-samples", "100")
    assert answer.code == 1 and "100" in answer.err and "a rate of" in answer.err, answer.err
    works = answer.err.split("a rate of ")[1].split()[0]
    found = beeline(*verb, "--rate", works, "--max-samples", "100", "--json")
    assert found.code == 0 and found.json["samples"] <= 100, found.err


def test_a_rate_that_makes_too_many_samples_is_answered_with_a_usual_one(beeline, files):
    answer = beeline(*LINE, "--rate", "1e6")
    assert answer.code == 1 and "a rate of 1000 works" in answer.err, answer.err
    assert "max_samples" not in answer.err


def test_work_is_counted_while_samples_are_read_and_made(beeline, written):
    rows = "".join(f"{k / 1000},{k / 1e5},{(k % 7) / 1e6},0\n" for k in range(20000))
    written("long.csv", "t,joint1,joint2,joint3\n" + rows)
    answer = beeline("retime", "rrr", "long.csv", "--max-work", "1000", "--json")
    assert answer.code == 1 and answer.json["status"] == "work_limit"


def test_a_long_recording_is_replayed_without_a_rate(beeline, written):
    rows = "".join(f"{k / 1000},{k / 1e5},0,0\n" for k in range(20000))
    written("long.csv", "t,joint1,joint2,joint3\n" + rows)
    answer = beeline("replay", "rrr", "long.csv", "--json")
    assert answer.code == 0 and answer.json["samples"] == 20000


def test_a_day_of_rest_is_within_limits(beeline, written):
    written("day.csv", "motion,relative,x,y,z,roll,pitch,yaw,dwell\n"
            "joint,,0.5,-0.2,0.5,180,0,0,86400\nline,previous,0.02,0,0,0,0,0,0.5\n"
            "line,previous,0,0.02,0,0,0,0,0\n")
    for interpolation in ("linear", "cubic", "quintic"):
        answer = beeline("line", "panda", "--degrees", "--through", "day.csv", "--interpolation",
                         interpolation, "--out", "out.csv", "--json")
        assert answer.code == 0, answer.err
        for options in (("--speed", "0.9"), ("--rate", "1")):
            assert beeline("replay", "panda", "out.csv", *options).code == 0


def test_a_replay_that_is_ended_has_no_duration(beeline, files):
    answer = beeline("replay", "panda", "move.csv", "--rate", "333", "--time-limit", "0", "--json")
    assert answer.code == 1 and answer.json["duration"] is None
    line = beeline(*LINE, "--time-limit", "0", "--json")
    assert line.json["path_parameter"] == 0


def test_a_program_that_is_ended_has_no_path_parameter(beeline, written):
    written("p.csv", "motion,x,y,z,roll,pitch,yaw\njoint,0.5,-0.2,0.5,180,0,0\nline,0.5,0.2,0.4,180,0,20\n")
    answer = beeline("line", "panda", "--degrees", "--through", "p.csv", "--time-limit", "0", "--json")
    assert answer.code == 1 and answer.json["path_parameter"] is None


def test_a_short_dwell_is_no_dwell_of_zero(beeline, written, tmp_path):
    written("p.csv", "motion,x,y,z,roll,pitch,yaw,dwell\njoint,0.4,-0.2,0.5,180,0,0,1e-7\n"
            "line,0.4,-0.3,0.4,180,0,20,0\n")
    assert beeline("export", "ur5", "p.csv", "--degrees", "--as", "urscript", "--out", "p.script").code == 0
    assert "sleep(0.000001)" in (tmp_path / "p.script").read_text()
