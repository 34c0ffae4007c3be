"""export: the files for controllers, read by independent readers and compared with the trajectory."""

import csv
import math
import re

import numpy as np
import pytest

import ros_message
import urscript

UR5E = ("--from", "0,-1.5,1.5,0,0.5,0", "--to", "0.5,-1,1,0,0.3,-0.25")
LINE = "x,y,z,roll,pitch,yaw\n-0.4,-0.3,0.4,3,0,0\n-0.4,0.2,0.4,3,0,0.2\n"


class Motion:
    """A trajectory as a file of CSV holds it, and the motion that its columns mean."""

    def __init__(self, path):
        with open(path) as file:
            rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
        self.names = [name for name in rows[0] if name != "t" and not name.endswith(("_vel", "_acc"))]
        self.t = np.array([float(row["t"]) for row in rows])
        column = lambda suffix: np.array(
            [[float(row[name + suffix]) for name in self.names] for row in rows])
        self.columns = [column("")]
        for suffix in ("_vel", "_acc"):
            if self.names[0] + suffix in rows[0]:
                self.columns.append(column(suffix))

    def at(self, t):
        """Position, velocity and acceleration at time t: the polynomial through the columns at both
        ends of its interval, from the linear system that these conditions are."""
        k = min(max(np.searchsorted(self.t, t, side="right"), 1), len(self.t) - 1)
        h, u = self.t[k] - self.t[k - 1], min(max((t - self.t[k - 1]) / (self.t[k] - self.t[k - 1]), 0), 1)
        order = len(self.columns)

        def derivative(i, x):  # row of the i-th derivative of 1, x, x^2, ...
            return [math.perm(n, i) * x ** (n - i) if n >= i else 0.0 for n in range(2 * order)]

        system = [derivative(i, x) for x in (0.0, 1.0) for i in range(order)]
        values = [self.columns[i][j] * h**i for j in (k - 1, k) for i in range(order)]
        c = np.linalg.solve(np.array(system), np.array(values))
        return [np.array(derivative(i, u)) @ c / h**i for i in range(order)]


@pytest.fixture(params=["quickest", "line", "cubic", "linear"])
def moved(request, beeline, written, tmp_path):
    """A motion of a UR5e in move.csv, with accelerations, with velocities, or with neither."""
    if request.param == "line":
        path = written("poses.csv", LINE)
        made = beeline("line", "ur5e", "--through", path, "--rate", "100", "--out", "move.csv")
    else:
        made = beeline("move", "ur5e", *UR5E, "--method", "quickest", "--out", "move.csv")
    assert made.code == 0, made.err
    keep = {"cubic": 13, "linear": 7}.get(request.param)
    if keep:
        lines = (tmp_path / "move.csv").read_text().splitlines()
        written("move.csv", "\n".join(",".join(line.split(",")[:keep]) for line in lines) + "\n")
    return Motion(tmp_path / "move.csv")


@pytest.fixture
def exported(beeline, tmp_path):
    """exported(form, file, ...) -> (text, report of --json)"""

    def run(form, out, *options):
        command = ("export", "ur5e", "move.csv", "--as", form, "--out", out, *options)
        told = beeline(*command)
        assert told.code == 0 and told.out == "", told.err
        text = (tmp_path / out).read_text()
        report = beeline(*command, "--json").json
        assert (tmp_path / out).read_text() == text and report["out"] == out
        assert report["proof"] in told.err and report["note"] in told.err
        assert report["not_proved"] and all("not proved    " + line + "\n" in told.err for line in report["not_proved"])
        return text, report

    return run


@pytest.mark.parametrize("out", ["move.yaml", "move.json"])
def test_a_ros_message_holds_the_trajectory(moved, exported, out):
    text, report = exported("ros2", out)
    message, times, comments = ros_message.read(text)
    assert message["joint_names"] == moved.names
    assert times == [round(t * 1e9) for t in moved.t]
    for i, column in enumerate(("positions", "velocities", "accelerations")):
        values = [point[column] for point in message["points"]]
        assert values == (moved.columns[i].tolist() if i < len(moved.columns) else [[]] * len(times))
    exact = all(round(t * 1e9) / 1e9 == t for t in moved.t)
    assert report["proof"].startswith("the limits of position and velocity at all times")
    assert ("what `beeline check` proves of the trajectory" in report["proof"]) == exact
    assert report["not_proved"][0] == "limits of acceleration and jerk: the arm has none"
    for text in (report["proof"], *report["not_proved"]):
        assert any(text in line for line in comments) == (out == "move.yaml")


def test_a_resampled_ros_message_has_the_states_of_the_motion(moved, exported):
    text, report = exported("ros2", "move.yaml", "--rate", "80")
    message, times, _ = ros_message.read(text)
    assert "differ from the trajectory's" in report["proof"]
    assert times == [round(k * 1e9 / 80) for k in range(len(times))]
    for point, time in list(zip(message["points"], times))[:-1]:
        state = moved.at(moved.t[0] + time * 1e-9)
        for i, column in enumerate(("positions", "velocities", "accelerations")[: len(state)]):
            if i < len(moved.columns) - 1 or len(moved.columns) in (1, 3):  # one-sided at samples
                assert point[column] == pytest.approx(state[i], abs=1e-6 * 10**i)


@pytest.mark.parametrize("rate", [None, 500, 100])
def test_a_ur_program_follows_the_motion(moved, exported, rate):
    text, report = exported("urscript", "move.script", *(("--rate", rate) if rate else ()))
    period = 1 / (rate or 125)
    comments, calls, values = urscript.read(text)
    assert any(report["proof"] in line for line in comments)
    assert [name for name, _ in calls] == (
        ["movej"] + ["servoj"] * (report["samples"] + 1) + ["stopj"])
    assert calls[0][1][0] == "first"
    assert urscript.numbers(values["first"]) == pytest.approx(moved.columns[0][0], abs=1e-9)
    setpoints = [call for name, call in calls if name == "servoj"]
    for k, call in enumerate(setpoints[:-1]):
        assert list(call) == [0, "t", "lookahead_time", "gain"]
        assert float(call["t"]) == pytest.approx(period, abs=1e-12)
        assert 0.03 <= float(call["lookahead_time"]) <= 0.2 and 100 <= float(call["gain"]) <= 2000
        expected = moved.at(min(moved.t[0] + k * period, moved.t[-1]))[0]
        assert urscript.numbers(call[0]) == pytest.approx(expected, abs=1e-9)
    assert setpoints[-1][0] == setpoints[-2][0]  # held, because the arm follows with a delay
    duration = moved.t[-1] - moved.t[0]
    assert duration - 1e-9 <= report["duration"] < duration + period


def test_instructions_of_abb_and_kuka_pass_the_samples(moved, exported):
    degrees = np.degrees(moved.columns[0])
    text, report = exported("rapid", "move.mod")
    assert report["proof"].startswith("only the positions of the samples, within the limits of position;")
    assert report["not_proved"] == [
        "limits of velocity, acceleration and jerk: the motion between the samples is the controller's"]
    lines = [line.strip() for line in text.splitlines() if not line.strip().startswith("!")]
    assert lines[:2] == ["MODULE move", "PROC play_move()"] and lines[-2:] == ["ENDPROC", "ENDMODULE"]
    pattern = re.compile(r"MoveAbsJ \[\[([^\]]*)\],\[9E9(?:,9E9){5}\]\]\\NoEOffs,v100(?:\\T:=([\d.]+))?"
                         r",(fine|z1),tool0;")
    moves = [pattern.fullmatch(line) for line in lines[2:-2]]
    assert len(moves) == len(degrees) and moves[0][2] is None
    for k, move in enumerate(moves):
        assert [float(x) for x in move[1].split(",")] == pytest.approx(degrees[k], abs=6e-7)
        assert k == 0 or float(move[2]) == pytest.approx(max(moved.t[k] - moved.t[k - 1], 1e-3), abs=6e-7)
    assert moves[0][3] == moves[-1][3] == "fine" and moves[1][3] == "z1"

    text, _ = exported("krl", "move.src")
    lines = [line for line in text.splitlines() if not line.startswith(";")]
    assert lines[0] == "DEF move()" and lines[-1] == "END"
    moves = [line for line in lines if line.startswith("PTP")]
    assert len(moves) == len(degrees)
    for k, line in enumerate(moves):
        match = re.fullmatch(r"PTP \{(A1 .*)\}( C_PTP)?", line)
        axes = dict(item.split() for item in match[1].split(","))
        assert list(axes) == [f"A{i}" for i in range(1, 7)]
        assert [float(x) for x in axes.values()] == pytest.approx(degrees[k], abs=6e-7)
    assert not moves[0].endswith("C_PTP") and moves[1].endswith("C_PTP") and moves[-1].endswith("}")


def test_pauses_are_waits(beeline, written, tmp_path):
    row = "0.5,0,0,0,0,0"
    written("move.csv", f"t,joint1,joint2,joint3,joint4,joint5,joint6\n0,0,0,0,0,0,0\n1,{row}\n3.5,{row}\n"
                        "4,1,0,0,0,0,0\n")
    for form, out, wait in (("rapid", "a.mod", "WaitTime 2.500000;"), ("krl", "a.src", "WAIT SEC 2.500000")):
        assert beeline("export", "ur5e", "move.csv", "--as", form, "--out", out).code == 0
        lines = [line.strip() for line in (tmp_path / out).read_text().splitlines()]
        at = lines.index(wait)
        assert ",fine," in lines[at - 1] or lines[at - 1].endswith("}")


def test_setpoints_are_the_motion_at_equal_times(moved, exported, beeline, tmp_path):
    text, report = exported("csv", "points.csv", "--rate", "333")
    points = Motion(tmp_path / "points.csv")
    assert points.names == moved.names and len(points.columns) == 1
    assert points.t == pytest.approx([k / 333 for k in range(report["samples"])], abs=1e-12)
    for t, q in zip(points.t, points.columns[0]):
        assert q == pytest.approx(moved.at(min(moved.t[0] + t, moved.t[-1]))[0], abs=1e-9)
    assert q.tolist() == moved.columns[0][-1].tolist()
    assert beeline("diff", "ur5e", "points.csv", "move.csv").code == 0  # comments are skipped


def test_the_first_sample_is_at_time_zero(beeline, written, tmp_path):
    written("late.csv", "t,joint1,joint2,joint3\n5.1,0,0,0\n5.2,0.1,0,0\n5.3,0,0,0\n")
    assert beeline("export", "rrr", "late.csv", "--as", "ros2", "--out", "a.json").code == 0
    assert ros_message.read((tmp_path / "a.json").read_text())[1] == [0, 10**8, 2 * 10**8]
    report = beeline("export", "rrr", "late.csv", "--as", "ros2", "--out", "a.json", "--json").json
    assert report["proof"].startswith("the limits of position ") and "straight lines" in report["proof"]


def test_messages_in_rows_have_times(beeline, written, tmp_path):
    names = "joint1,joint2,joint3"
    rows = "".join(f"{5 + k // 2},{k % 2 * 500000000},base,{names},{0.1 + k / 20},0.2,0.3\n" for k in range(3))
    answer = beeline("export", "rrr", written("ros2.csv", rows), "--as", "ros2", "--out", "out.json")
    assert answer.code == 0, answer.err
    assert ros_message.read((tmp_path / "out.json").read_text())[1] == [0, 5 * 10**8, 10**9]


def test_a_motion_that_does_not_end_at_rest_is_noted(beeline, written):
    written("a.csv", "t,joint1,joint2,joint3,joint1_vel,joint2_vel,joint3_vel\n0,0,0,0,0,0,0\n1,1,0,0,1,0,0\n")
    report = beeline("export", "rrr", "a.csv", "--as", "ros2", "--out", "a.json", "--json").json
    assert "allow_nonzero_velocity_at_trajectory_end" in report["note"]


SEVEN = "t," + ",".join(f"joint{i}" for i in range(1, 8)) + "\n0,0,0,0,-1,0,1,0\n1,0,0,0,-1,0,1.5,0\n"
SIX = "t," + ",".join(f"joint{i}" for i in range(1, 7)) + "\n0,0,0,0,0,0,0\n1,0,0,0,0,0,1\n"


@pytest.mark.parametrize("code, arm, text, options, says", [
    (2, "panda", SEVEN, ("--as", "urscript", "--out", "a.script"), ["six revolute joints", "has 7"]),
    (2, "panda", SEVEN, ("--as", "krl", "--out", "a.src"), ["six revolute joints"]),
    (2, "RRRRRP", SIX, ("--as", "rapid", "--out", "a.mod"), ['"joint6" is not revolute']),
    (2, "ur5", SIX, ("--as", "urscript", "--out", "a.script", "--rate", "300"), ["--rate", "500 / n", "300"]),
    (2, "ur5", SIX, ("--as", "urscript", "--out", "a.script", "--rate", "1000"), ["--rate", "500 / n"]),
    (2, "ur5", SIX, ("--as", "csv", "--out", "a.csv"), ["csv setpoints need the --rate in samples per second"]),
    (2, "ur5", SIX, ("--as", "csv", "--out", "a.csv", "--rate", "1e9"), ["--rate", "10 million"]),
    (2, "ur5", SIX, ("--as", "krl", "--out", "a-b.src"), ['"a-b"', "KRL", "24"]),
    (2, "ur5", SIX, ("--as", "krl", "--out", "loop.src"), ['"loop"', "KRL"]),
    (2, "ur5", SIX, ("--as", "krl", "--out", "a" * 25 + ".src"), ["24 characters"]),
    (2, "ur5", SIX, ("--as", "rapid", "--out", "test.mod"), ['"test"', "RAPID"]),
    (2, "ur5", SIX, ("--as", "rapid", "--out", "1a.mod"), ["RAPID", "a letter"]),
    (2, "ur5", SIX, ("--as", "rapid", "--out", "a.src"), ["rapid", ".mod", "a.src"]),
    (2, "ur5", SIX, ("--as", "ros2", "--out", "a.csv"), [".yaml", ".json"]),
    (2, "ur5", SIX, ("--as", "ros", "--out", "a.yaml"), ["--as", "ros2"]),
    (2, "ur5", SIX, ("--out", "a.yaml"), ["--as"]),
    (2, "ur5", SIX, ("--as", "csv", "--rate", "9", "--out", "in.csv"), ["input"]),
    (2, "ur5", SIX.replace("\n1,", "\n3e9,"), ("--as", "ros2", "--out", "a.yaml"), ["32 bits"]),
    (2, "ur5", SIX.replace("\n1,", "\n1e-10,"), ("--as", "ros2", "--out", "a.yaml"), ["same nanosecond"]),
    (3, "panda", SIX, ("--as", "ros2", "--out", "a.yaml"), ["in.csv", "joint7"]),
])
def test_what_a_form_cannot_hold_is_refused(refused, written, tmp_path, code, arm, text, options, says):
    written("in.csv", text)
    refused(code, "export", arm, "in.csv", *options, says=says)
    assert [path.name for path in tmp_path.iterdir()] == ["in.csv"]


def test_the_exported_message_is_proved_as_the_trajectory_is(beeline, written, exported):
    path = written("poses.csv", LINE)
    made = beeline("line", "ur5e", "--through", path, "--out", "move.csv", "--json").json
    prove = lambda file: beeline("check", "ur5e", file, "--through", path, "--json")
    _, report = exported("ros2", "move.json")
    answer = prove("move.json")
    assert "what `beeline check` proves" in report["proof"] and report["samples"] == made["samples"]
    assert answer.code == 0 and answer.json == prove("move.csv").json
    _, report = exported("ros2", "fast.json", "--rate", "200")
    assert "what `beeline check` proves" not in report["proof"] and "moves at the last" not in report["note"]


def test_a_reader_of_yaml_reads_the_message(beeline, tmp_path):
    yaml = pytest.importorskip("yaml")
    assert beeline("move", "ur5e", *UR5E, "--method", "quickest", "--out", "move.csv").code == 0
    assert beeline("export", "ur5e", "move.csv", "--as", "ros2", "--out", "move.yaml").code == 0
    text = (tmp_path / "move.yaml").read_text()
    assert yaml.safe_load(text) == ros_message.read(text)[0]


OUTSIDE = "t,joint1,joint2,joint3\n0,0,0,0\n1,0.5,0,0\n2,1.5,0,0\n3,0,0,0\n"


def limited(written, joint):
    """RRR with these limits of its first joint."""
    return ("RRR:1,1,1", "--limits", written("limits.json", '{"joint1": %s}' % joint))


@pytest.mark.parametrize("form, out", [("ros2", "a.yaml"), ("csv", "a.csv"), ("ros2", "a.json")])
def test_positions_outside_the_limits_are_refused(beeline, written, tmp_path, form, out):
    written("move.csv", OUTSIDE)
    command = ("export", *limited(written, '{"lower": -1, "upper": 1.2, "velocity": 9}'), "move.csv", "--as", form, "--out", out,
               *(("--rate", 10) if form == "csv" else ()))
    told = beeline(*command, "--json")
    assert told.code == 1 and told.json["status"] == "outside_limits" and not (tmp_path / out).exists()
    assert told.json["code"] == "outside_limits"
    fields = told.json["fields"]
    assert (fields["joint"], fields["time"], fields["value"], fields["upper"]) == ("joint1", 2, 1.5, 1.2)
    for word in ("joint1", "2 s", "1.5", "1.2"):
        assert word in beeline(*command).err
    told = beeline(*command, "--ignore-limits", "--json")
    assert told.code == 0 and any(line.startswith("limits of position") and "1.5" in line
                                  for line in told.json["not_proved"])
    assert "position" not in told.json["proof"].split(";")[0].replace("positions", "")


def test_other_limits_that_the_arm_has_are_refused_where_the_form_carries_them(beeline, written, tmp_path):
    written("move.csv", OUTSIDE)
    arm = limited(written, '{"velocity": 0.9}')
    told = beeline("export", *arm, "move.csv", "--as", "ros2", "--out", "a.json", "--json")
    assert told.code == 1 and told.json["fields"]["quantity"] == "velocity" and not told.json["fields"]["assumed"]
    allowed = beeline("export", *arm, "move.csv", "--as", "ros2", "--out", "a.json", "--json", "--ignore-limits").json
    assert allowed["proof"].startswith("the limits of position at all times")
    assert any(line.startswith("limits of velocity: ") and "0.9" in line for line in allowed["not_proved"])
    # Setpoints say nothing of velocities, with the limit or without.
    other = beeline("export", *arm, "move.csv", "--as", "csv", "--rate", 10, "--out", "a.csv", "--json").json
    assert other["not_proved"] == [
        "limits of velocity, acceleration and jerk: the motion between the samples is the controller's"]
    within = beeline("export", *limited(written, '{"velocity": 1.47}'), "move.csv", "--as", "ros2", "--out", "a.json")
    assert within.code == 1
    assert beeline("export", *limited(written, '{"velocity": 1.47}'), "move.csv", "--as", "ros2", "--out", "a.json",
                   "--limit-tolerance", 0.03).code == 0


def test_limits_that_the_arm_does_not_have_are_named(beeline, written):
    written("move.csv", OUTSIDE)
    command = ("move.csv", "--as", "ros2", "--out", "a.json", "--json")
    none = beeline("export", "RRR:1,1,1", *command).json
    assert none["proof"].startswith("the limits of position at all times")
    assert none["not_proved"][0] == "limits of velocity, acceleration and jerk: the arm has none"
    assert len(none["not_proved"]) == 1
    written("moving.csv", "t,joint1,joint2,joint3,joint1_vel,joint2_vel,joint3_vel\n0,0,0,0,0.5,0,0\n1,0.5,0,0,0,0,0\n")
    moving = beeline("export", "RRR:1,1,1", "moving.csv", *command[1:]).json
    assert moving["not_proved"][1].startswith("rest at the ends: ") and "0.5" in moving["not_proved"][1]
    some = beeline("export", *limited(written, '{"velocity": 2, "acceleration": 9, "jerk": 99}'), *command).json
    assert some["not_proved"][0] == "limits of velocity, acceleration and jerk: joints joint2, joint3 have none"
    all_of = beeline("export", "RRR:1,1,1", "--velocity", 2, "--acceleration", 90, "--jerk", 999, *command).json
    assert all_of["proof"].startswith("the limits of position and velocity at all times")
    assert all_of["not_proved"][0] == "limits of acceleration and jerk: not bounded by straight lines"


def test_limits_are_not_options_of_programs(refused, written):
    written("pick.csv", "motion,x,y,z,roll,pitch,yaw\nline,-0.4,-0.3,0.2,3,0,0\nline,-0.4,-0.3,0.3,3,0,0\n")
    for option in (("--ignore-limits",), ("--limit-tolerance", "0.01")):
        refused(2, "export", "ur5e", "pick.csv", "--as", "urscript", "--out", "a.script", *option,
                says=[option[0], "is for trajectories", "pick.csv"])
