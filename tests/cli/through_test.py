"""move --through: the quickest motion through configurations, and retime --joint-blend."""

import csv
import json

import pytest

WAYPOINTS = [(0.0, 1.0, 0.0), (0.6, 0.8, -0.4), (1.0, 0.2, 0.2), (1.2, 0.4, 0.6)]


@pytest.fixture
def through(beeline, written):
    """through(*options) -> the answer of a motion from the first configuration through the others."""
    written("q.csv", "".join(f"{a},{b},{c}\n" for a, b, c in WAYPOINTS[1:]))
    return lambda *options: beeline("move", "rrr", "--from", "0,1,0", "--method", "quickest",
                                    "--through", "q.csv", *options)


def rows_of(path):
    return [[float(row[f"joint{k}"]) for k in (1, 2, 3)] for row in csv.DictReader(open(path))]


def nearest(rows, waypoint):
    return min(sum((a - b) ** 2 for a, b in zip(row, waypoint)) ** 0.5 for row in rows)


def test_the_spline_passes_the_configurations(through, tmp_path):
    answer = through("--out", "m.csv", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["sections"] == 1 and "blends" not in answer.json
    assert answer.json["method"] == "quickest" and answer.json["error"] < 1e-8
    rows = rows_of(tmp_path / "m.csv")
    assert all(nearest(rows, waypoint) < 1e-8 for waypoint in WAYPOINTS)
    assert rows[0] == pytest.approx(WAYPOINTS[0]) and rows[-1] == pytest.approx(WAYPOINTS[-1])
    assert answer.json["limits"]["velocity"]["fraction"] <= 1 + 1e-6


def test_twins_are_warned_of(beeline, written):
    twin = WAYPOINTS[:3] + [tuple(value + 1e-6 for value in WAYPOINTS[2])] + WAYPOINTS[3:]
    written("twin.csv", "".join(f"{a},{b},{c}\n" for a, b, c in twin[1:]))
    move = ("move", "rrr", "--from", "0,1,0", "--method", "quickest", "--through", "twin.csv")
    answer = beeline(*move)
    assert answer.code == 0 and "configuration 2 and configuration 3 are 1.73205e-06 apart" in answer.err
    answer = beeline(*move, "--joint-blend", "0.1")
    assert answer.code == 0 and "apart" not in answer.err


def test_blends_pass_near_them(through, beeline, tmp_path):
    answer = through("--joint-blend", "0.1", "--out", "m.csv", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["blends"] == [0.1, 0.1] and answer.json["sections"] == 1
    assert all(nearest(rows_of(tmp_path / "m.csv"), waypoint) < 0.1 for waypoint in WAYPOINTS)
    stops = through("--joint-blend", "0")
    assert stops.code == 0 and "with 2 stops between" in stops.out and "blends        0 blends\n" in stops.out
    assert "2 blends of radius 0.1\n" in through("--joint-blend", "0.1").out
    (tmp_path / "all.csv").write_text("".join(f"{a},{b},{c}\n" for a, b, c in WAYPOINTS))
    again = beeline("retime", "rrr", "all.csv", "--joint-blend", "0.1", "--out", "r.csv")
    assert again.code == 0 and (tmp_path / "r.csv").read_bytes() == (tmp_path / "m.csv").read_bytes()
    assert beeline("check", "rrr", "m.csv").code == 0


def test_positions_that_are_close_are_stops(beeline, written):
    written("dense.csv", "".join(f"{k / 1000},0.5,0\n" for k in range(1, 6)))
    answer = beeline("move", "rrr", "--from", "0,0.5,0", "--method", "quickest", "--through", "dense.csv",
                     "--joint-blend", "0.05", "--json")
    assert answer.code == 0 and answer.json["blends"] == [0] * 4


def test_degrees_and_durations(through, beeline, written, tmp_path):
    written("d.csv", "30,20,-10\n60,10,10\n")
    answer = beeline("move", "rrr", "--from", "0,45,0", "--degrees", "--method", "quickest", "--through", "d.csv",
                     "--duration", "9", "--out", "m.csv", "--json")
    assert answer.code == 0 and answer.json["duration"] == 9, answer.err
    assert rows_of(tmp_path / "m.csv")[-1] == pytest.approx([1.0471975511965976, 0.17453292519943295, 0.17453292519943295])
    assert "the shortest" in through("--duration", "0.01").err


def test_refusals_are_one_line(through, beeline, written):
    def refused(*options, code=2):
        answer = beeline("move", "rrr", "--from", "0,1,0", *options)
        assert answer.code == code and answer.err.count("\n") == 1, answer.err
        return answer.err

    through()  # writes the file
    assert "two goals" in refused("--method", "quickest", "--through", "q.csv", "--to", "0,0,0")
    assert "--method" in refused("--through", "q.csv")
    assert "--through" in refused("--method", "quickest")
    assert "needs --through or --method around" in refused("--method", "quickest", "--to", "1,1,1", "--joint-blend", "0.1")
    written("two.csv", "0,1\n")
    assert "two.csv" in refused("--method", "quickest", "--through", "two.csv", code=3)
    assert "input" in refused("--method", "quickest", "--through", "q.csv", "--out", "q.csv")
    assert through("--joint-blend", "-1").code == 2
    assert "--synchronise" in refused("--method", "quickest", "--through", "q.csv", "--synchronise", "straight")
    assert "--through" in refused("--method", "quickest", "--to", "1,1,1", "--angle-unit", "deg")
    assert json.loads(through("--json").out)["status"] == "reached"
