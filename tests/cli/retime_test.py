"""retime: new times for a recording, or for waypoints without times."""

import csv
import json
import subprocess

import pytest

from profiles import PROFILES

WAYPOINTS = (
    "joint1,joint2,joint3,joint4,joint5,joint6,joint7\n"
    "0,-0.785,0,-2.356,0,1.571,0.785\n"
    "0.5,-0.2,0.3,-1.9,0.2,1.9,0.3\n"
    "-0.4,0.3,-0.2,-1.5,-0.6,2.2,1.0\n"
    "0.9,0.1,0.5,-2.2,0.4,1.2,-0.3\n"
)


def rows_of(path):
    with open(path) as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize("profile", PROFILES)
def test_waypoints_without_times_become_a_motion_within_limits(beeline, written, tmp_path, profile):
    path = written("waypoints.csv", WAYPOINTS)
    answer = beeline("retime", "panda", path, "--profile", profile, "--out", "move.csv", "--json")
    assert answer.code == 0, answer.err
    report = answer.json
    assert report["status"] == "reached" and report["profile"] == profile and report["reason"] == ""
    assert report["duration_before"] is None
    for kind in ("velocity", "acceleration", "jerk"):
        use = report["limits"][kind]
        assert use["joint"].startswith("joint") and 0 <= use["time"] <= report["duration"]
        if kind != "jerk" or profile not in ("fastest", "trapezoidal"):
            assert use["fraction"] <= 1 + 1e-9
    rows = rows_of(tmp_path / "move.csv")
    assert len(rows) == report["samples"]
    assert float(rows[-1]["t"]) == report["duration"]
    columns = WAYPOINTS.splitlines()[0].split(",")
    moved = [[float(row[name]) for name in columns] for row in rows]
    for line in WAYPOINTS.splitlines()[1:]:
        given = [float(value) for value in line.split(",")]
        # Times are rounded to nanoseconds.
        assert min(max(abs(a - b) for a, b in zip(q, given)) for q in moved) <= 3e-9
    assert beeline("replay", "panda", "move.csv").code == 0  # within limits of velocity


def test_the_default_law_keeps_the_arms_limits_of_jerk_where_it_has_them(beeline, written):
    path = written("waypoints.csv", WAYPOINTS)
    assert beeline("retime", "panda", path, "--json").json["profile"] == "jerk"
    six = "\n".join(line.rsplit(",", 1)[0] for line in WAYPOINTS.splitlines())
    report = beeline("retime", "ur5", written("six.csv", six), "--json").json
    assert report["profile"] == "jerk" and report["limits"]["jerk"]["assumed"]


def test_a_line_keeps_its_way_and_takes_less_time_than_by_a_fixed_law(beeline, written, tmp_path):
    through = written("waypoints.csv", "x,y,theta\n4.5,5.2,0\n2,6,45\n5,3,-20\n")
    beeline("line", "rrr", "--from", "0,90,0", "--degrees", "--through", through,
            "--profile", "quintic", "--out", "line.csv")
    report = beeline("retime", "rrr", "line.csv", "--out", "quick.json", "--json").json
    assert report["duration"] < report["duration_before"]
    assert report["sections"] == 3  # it stops at every corner
    assert beeline("replay", "rrr", "quick.json").code == 0
    points = json.loads((tmp_path / "quick.json").read_text())["points"]
    quick = [point["positions"] for point in points]
    for row in rows_of(tmp_path / "line.csv"):
        given = [float(row[f"joint{i}"]) for i in (1, 2, 3)]
        assert min(max(abs(a - b) for a, b in zip(q, given)) for q in quick) <= 3e-9


def test_speed_limits_and_rate(beeline, written, tmp_path):
    path = written("waypoints.csv", WAYPOINTS)
    full = beeline("retime", "panda", path, "--json").json["duration"]
    half = beeline("retime", "panda", path, "--speed", "0.5", "--json").json
    assert half["duration"] == pytest.approx(2 * full, rel=1e-2)
    assert half["limits"]["velocity"]["fraction"] <= 1 + 1e-9  # of the scaled limits
    slow = beeline("retime", "panda", path, "--tool-speed", "0.25", "--json").json
    assert 0.2 < slow["tool_speed"] <= 0.25 * (1 + 1e-9)
    beeline("retime", "panda", path, "--rate", "100", "--out", "rated.csv")
    times = [float(row["t"]) for row in rows_of(tmp_path / "rated.csv")]
    assert times[:-1] == pytest.approx([k / 100 for k in range(len(times) - 1)])


def test_a_path_outside_the_position_limits_is_a_no(beeline, written, tmp_path):
    path = written("waypoints.csv", WAYPOINTS.replace("-1.9", "0.5"))
    answer = beeline("retime", "panda", path, "--out", "move.csv", "--json")
    assert answer.code == 1
    assert answer.json["status"] == "outside_limits" and "joint4" in answer.json["reason"]
    assert answer.json["duration"] is None
    assert answer.err == f"beeline: {answer.json['reason']}\n"
    assert not (tmp_path / "move.csv").exists()


def test_bad_input_is_refused_in_one_line(refused, beeline, written):
    path = written("waypoints.csv", WAYPOINTS)
    refused(2, "retime", "panda", path, "--profile", "scurve", says=("scurve", "s-curve"))
    refused(2, "retime", "panda", path, "--rate", "0", says=("--rate",))
    line = refused(1, "retime", "panda", path, "--rate", "1e9", says=("samples", "a rate of"))
    works = line.split("a rate of ")[1].split()[0]
    assert beeline("retime", "panda", path, "--rate", works).code == 0
    for scale in ("2", "1e-300"):
        refused(2, "retime", "panda", path, "--speed", scale, says=("--speed", "from 1e-06 to 1", scale))
    for speed in ("-1", "1e-300"):
        refused(2, "retime", "panda", path, "--tool-speed", speed, says=("--tool-speed", "at least 1e-08", speed))
    refused(2, "retime", "panda", path, "--out", path, says=("input",))
    refused(3, "retime", "ur5", path, says=("waypoints.csv", "joint7"))
    refused(3, "retime", "panda", written("half.csv", WAYPOINTS[:-6]), says=("half.csv:5",))
    refused(3, "retime", "panda", "none.csv", says=("none.csv",))
    lines = WAYPOINTS.splitlines()
    refused(3, "retime", "panda", written("one.csv", "\n".join(lines[:2])),
            says=("one.csv", "two different positions", "one sample"))
    refused(3, "retime", "panda", written("still.csv", "\n".join([lines[0], lines[1], lines[1]])),
            says=("still.csv", "two different positions", "2 samples"))


def test_a_trajectory_from_a_pipe(build, beeline, written, tmp_path):
    written("move.csv", "t,joint1,joint2,joint3\n0,0,0,0\n1,1,0,0\n2,1,1,0\n")
    expected = beeline("retime", "rrr", "move.csv", "--json").json
    for form in ("played.csv", "played.json"):
        beeline("replay", "rrr", "move.csv", "--out", form)
        command = f"{build}/beeline replay rrr <(cat {form}) --json"
        process = subprocess.run(["bash", "-c", command], capture_output=True, text=True,
                                 cwd=tmp_path)
        assert process.returncode == 0, process.stderr
        assert json.loads(process.stdout) == beeline("replay", "rrr", form, "--json").json
    process = subprocess.run(["bash", "-c", f"{build}/beeline retime rrr <(cat move.csv) --json"],
                             capture_output=True, text=True, cwd=tmp_path)
    assert process.returncode == 0 and json.loads(process.stdout) == expected
