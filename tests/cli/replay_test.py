"""replay with changing speed, and its tracking error."""

import csv
import re

import pytest


@pytest.fixture
def recording(beeline):
    """The name of a recording of a panda, of about 1 s."""
    answer = beeline("move", "panda", "--from", "0,-0.8,0,-2.4,0,1.6,0.8", "--to",
                     "2,-0.3,0.2,-1.9,0.1,2,0.3", "--method", "quickest", "--out", "move.csv")
    assert answer.code == 0
    return "move.csv"


def rows_of(path):
    return [{name: float(text) for name, text in row.items()} for row in csv.DictReader(path.open())]


def test_it_pauses_and_continues(beeline, recording, tmp_path):
    answer = beeline("replay", "panda", recording, "--speed-at", "0:0.5,1:0,5:1", "--rate", "200",
                     "--out", "played.csv", "--json")
    assert answer.code == 0, answer.err
    rows, recorded = rows_of(tmp_path / "played.csv"), rows_of(tmp_path / recording)
    assert rows[-1]["t"] == answer.json["duration"] > 5
    for joint in ("joint1", "joint7"):
        assert rows[0][joint] == recorded[0][joint] and rows[-1][joint] == recorded[-1][joint]
    paused = [row for row in rows if 4 <= row["t"] <= 5]
    assert len({row["joint1"] for row in paused}) == 1
    assert all(row["joint1_vel"] == 0 for row in paused)
    assert max(row["joint1_vel"] for row in rows) > 0.5


def test_its_times_include_the_lead_in(beeline, recording):
    there = ("replay", "panda", recording, "--from", "0.5,-0.8,0,-2.4,0,1.6,0.8")
    at_once = beeline(*there, "--speed-at", "0:1", "--json").json
    paused = beeline(*there, "--speed-at", "0.05:0,3:1", "--ramp", "0.1",
                     "--json").json
    assert paused["lead_in"] > 3 > at_once["lead_in"] > 0


def test_the_tracking_error(beeline, recording, tmp_path):
    speeds = ("--speed-at", "0:0.5,1:0,2:1")
    assert beeline("replay", "panda", recording, *speeds, "--out", "played.csv").code == 0
    with (tmp_path / "measured.csv").open("w") as file:
        rows = rows_of(tmp_path / "played.csv")
        writer = csv.DictWriter(file, ["t"] + [f"joint{i}" for i in range(1, 8)],
                                extrasaction="ignore")
        writer.writeheader()
        for number, row in enumerate(rows):
            row["joint3"] += 0.01 if number % 2 else -0.03
            writer.writerow(row)
    answer = beeline("replay", "panda", recording, *speeds, "--measured", "measured.csv", "--json")
    assert answer.code == 0, answer.err
    joints = answer.json["tracking"]["joints"]
    assert joints[2]["largest"] == pytest.approx(0.03) and 0.01 < joints[2]["rms"] < 0.03
    assert joints[0]["largest"] == joints[0]["rms"] == 0
    diff = beeline("diff", "panda", "played.csv", "measured.csv", "--json").json
    assert {key: diff[key] for key in answer.json["tracking"]} == answer.json["tracking"]
    text = beeline("replay", "panda", recording, *speeds, "--measured", "measured.csv").out
    assert "measured.csv" in text and "joint3" in text and "0.03" in text


@pytest.mark.parametrize("rate", ["50", "60", "1000"])
@pytest.mark.parametrize("options", [(), ("--speed", "0.9"), ("--speed-at", "0:1,0.3:0.4")])
def test_it_holds_all_limits_at_any_rate(beeline, recording, tmp_path, rate, options):
    answer = beeline("replay", "panda", recording, "--from", "0,-0.5,0,-2.4,0,1.6,0.8", "--rate", rate,
                     *options, "--out", "played.csv", "--json")
    assert answer.code == 0 and not answer.err, answer.err
    assert all(use["fraction"] <= 1 + 1e-8 for use in answer.json["limits"].values())
    assert 1 - 1e-9 <= answer.json["slowdown"] < 1.4
    times = [row["t"] for row in rows_of(tmp_path / "played.csv")]
    assert times == pytest.approx([round(k / float(rate), 9) for k in range(len(times))], abs=1e-12)
    again = beeline("replay", "panda", "played.csv", "--speed", "0.7", "--rate", "250", "--json")
    assert again.code == 0 and not again.err, again.err


@pytest.mark.parametrize("recorded, rate", [("100", "1000"), ("25", "200"), ("50", "125")])
def test_a_linear_recording_names_the_speed_and_the_rate_that_work(beeline, recording, recorded, rate):
    beeline("retime", "panda", recording, "--interpolation", "linear", "--rate", recorded, "--out", "linear.csv")
    answer = beeline("replay", "panda", "linear.csv", "--rate", rate)
    assert answer.code == 1 and "joint" in answer.err
    speed = re.search("a speed of ([0-9.]+) at this rate", answer.err)
    other = re.search("a rate of ([0-9.]+)", answer.err)
    assert speed or other, answer.err
    if speed:
        assert float(speed[1]) >= 0.5
        assert beeline("replay", "panda", "linear.csv", "--rate", rate, "--speed", speed[1]).code == 0
    if other:
        assert beeline("replay", "panda", "linear.csv", "--rate", other[1]).code == 0
        assert ("corners" in answer.err) == (float(rate) >= 2 * float(other[1]))


def test_a_recording_beyond_limits_is_played_with_a_warning(beeline, recording):
    answer = beeline("replay", "panda", recording, "--acceleration", "1", "--json")
    assert answer.code == 0
    assert "exceeds the acceleration limit" in answer.err and "keeps it" in answer.err


@pytest.mark.parametrize("speeds, says", [
    ("0:1,4:0", "4 s"), ("2", "2:0.5,4:0,6:1"), ("0:1,", "2:0.5,4:0,6:1"), ("0:x", "speed"),
    ("x:1", "time"), ("0:2", "from 0 to 1"), ("2:1,1:1", "increase"), ("0:-0.5", "from 0 to 1"),
])
def test_invalid_speeds(refused, recording, speeds, says):
    refused(2, "replay", "panda", recording, "--speed-at", speeds, says=[says])


def test_other_invalid_options(refused, recording):
    refused(2, "replay", "panda", recording, "--ramp", "1", says=["--ramp", "--speed-at"])
    refused(2, "replay", "panda", recording, "--speed-at", "0:1", "--ramp", "0", says=["ramp"])
    refused(3, "replay", "panda", recording, "--measured", "no.csv", says=["no.csv"])
    refused(2, "replay", "panda", recording, "--measured", "move.csv", "--out", "move.csv",
            says=["move.csv", "input"])
