"""line, move, replay, draw, figure; nothing is written when a motion is not possible."""

import csv

import pytest

WAYPOINTS = "x,y,theta\n4.5,5.2,0\n2,6,45\n5,3,-20\n"


def pose_rows(beeline, arm, configurations):
    rows = ["x,y,z,qw,qx,qy,qz"]
    for q in configurations:
        pose = beeline("fk", arm, "--q", q, "--json").json["pose"]
        quaternion = [pose["quaternion"][key] for key in ("qw", "qx", "qy", "qz")]
        rows.append(",".join(map(repr, pose["translation"] + quaternion)))
    return "\n".join(rows) + "\n"


def test_the_main_job_on_the_chapters_arm(beeline, written, tmp_path):
    through = written("waypoints.csv", WAYPOINTS)
    answer = beeline("line", "rrr", "--from", "0,90,0", "--degrees", "--through", through,
                     "--out", "move.csv", "--draw", "move.svg", "--json")
    assert answer.code == 0, answer.err
    report = answer.json
    assert {"status", "deviation_bound", "deviation_sampled", "samples", "reason"} <= set(report)
    assert report["status"] == "reached" and report["deviation_sampled"] < 1e-6
    assert report["deviation_sampled"] <= report["deviation_bound"] <= 1e-4 + 1e-9
    with open(tmp_path / "move.csv") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == report["samples"] and "joint1_vel" in rows[0]
    times = [float(row["t"]) for row in rows]
    assert all(a < b for a, b in zip(times, times[1:]))
    end = ",".join(rows[-1][f"joint{i}"] for i in (1, 2, 3))
    pose = beeline("fk", "rrr", "--q", end, "--json").json["pose"]["planar"]
    assert (pose["x"], pose["y"]) == pytest.approx((5, 3), abs=1e-8)
    assert (tmp_path / "move.svg").read_text().startswith("<?xml")


@pytest.mark.parametrize(
    "arm, start, goals",
    [
        ("panda", "0,-0.785,0,-2.356,0,1.571,0.785",
         ["0.3,-0.6,0.1,-2.2,0.1,1.7,0.9", "-0.3,-0.5,0,-2.0,-0.1,1.6,0.5"]),
        ("ur5", "0,-1.2,1.5,-0.5,1.2,0", ["0.4,-1.1,1.4,-0.4,1.3,0.2", "0.2,-1.4,1.7,-0.6,1.1,0"]),
    ],
)
def test_the_main_job_on_real_arms(beeline, written, tmp_path, arm, start, goals):
    through = written("poses.csv", pose_rows(beeline, arm, goals))
    report = beeline("line", arm, "--from", start, "--through", through, "--json",
                     "--out", "move.json", "--draw", "move.png").json
    assert report["status"] == "reached", report["reason"]
    assert report["deviation_sampled"] < 1e-6 and report["orientation_sampled"] < 1e-6
    replayed = beeline("replay", arm, "move.json", "--json")
    assert replayed.code == 0, replayed.err  # limits of position and velocity are kept
    assert (tmp_path / "move.png").read_bytes().startswith(b"\x89PNG")


def test_a_line_that_leaves_the_workspace_reports_where_and_why_and_writes_nothing(
        beeline, written, tmp_path):
    through = written("far.csv", "x,y,theta\n4.5,5.2,0\n12,5,0\n")
    answer = beeline("line", "rrr", "--from", "0,90,0", "--degrees", "--through", through,
                     "--out", "move.csv", "--draw", "move.svg", "--json")
    assert answer.code == 1
    assert answer.json["status"] == "unreachable" and answer.json["deviation_bound"] is None
    assert "line 2 of 2" in answer.json["reason"] and " x " in answer.json["reason"]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["far.csv"]


def test_a_line_whose_end_is_not_found_reports_whether_none_exists(beeline, written):
    through = written("w.csv", "x,y,z,roll,pitch,yaw\n-0.5,-0.1,1.0,0,0,0\n")
    answer = beeline("line", "ur5", "--from", "0,-1.2,1.5,-0.5,1.2,0", "--through", through, "--json")
    assert answer.code == 1
    assert (answer.json["status"] == "unreachable") != ("not shown" in answer.json["reason"])


def test_the_methods_of_the_chapter_can_be_compared(beeline, written):
    through = written("waypoints.csv", WAYPOINTS)

    def deviation(*options):
        answer = beeline("line", "rrr", "--from", "0,90,0", "--degrees", "--through", through,
                         "--json", *options)
        assert answer.code == 0, answer.err
        return answer.json["deviation_sampled"]

    exact = deviation()
    jacobian = deviation("--method", "inverse-jacobian", "--gain", "0.05")
    few = deviation("--method", "inverse-kinematics", "--intermediate", "2")
    many = deviation("--method", "inverse-kinematics", "--intermediate", "20")
    assert exact < 1e-7 < jacobian < few and many < few / 10


def test_the_effect_of_the_gain_is_reported(beeline):
    def steps_and_overshoot(gain):
        answer = beeline("move", "rrr", "--from", "0,0,0", "--to", "99.2,-68.8,-30.4", "--degrees",
                         "--gain", gain, "--json").json
        return answer["steps"], answer["overshoot"]

    slow, quick, large = map(steps_and_overshoot, ("0.01", "0.5", "1.5"))
    assert slow[0] > 10 * quick[0] and slow[1] == quick[1] == 0
    assert large[1] == pytest.approx(0.5)
    never = beeline("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--gain", "2.1", "--json")
    assert never.code == 1 and never.json["status"] == "not_converged"
    assert "too large" in never.json["reason"]


def test_record_and_replay(beeline, tmp_path):
    assert beeline("move", "rrr", "--from", "0,0,0", "--to", "1,-1,0.5", "--out", "a.csv").code == 0
    half = beeline("replay", "rrr", "a.csv", "--speed", "0.5", "--out", "b.csv", "--json").json
    whole = beeline("replay", "rrr", "a.csv", "--json").json
    assert half["duration"] == pytest.approx(2 * whole["duration"])
    assert beeline("replay", "rrr", "b.csv", "--from", "0.3,0,0", "--json").json["lead_in"] > 0
    other = beeline("replay", "rp", "a.csv")
    assert other.code == 3 and "joint3" in other.err and "a.csv" in other.err


@pytest.mark.parametrize("number", ["1.3", "1.6", "1.7", "1.8", "1.9"])
@pytest.mark.parametrize("ending, begins", [("svg", b"<?xml"), ("png", b"\x89PNG"), ("pdf", b"%PDF")])
def test_the_chapters_figures(beeline, tmp_path, number, ending, begins):
    assert beeline("figure", number, "--out", f"f.{ending}").code == 0
    assert (tmp_path / f"f.{ending}").read_bytes().startswith(begins)


def test_draw_an_arm_and_a_motion(beeline, tmp_path):
    assert beeline("draw", "puma560", "--frames", "--jacobian", "--out", "a.pdf").code == 0
    assert beeline("move", "panda", "--from", "0,-0.8,0,-2.4,0,1.6,0.8",
                   "--to", "0.5,0,0,-2,0,2,0", "--out", "m.json").code == 0
    assert beeline("draw", "panda", "m.json", "--out", "m.svg").code == 0
    assert (tmp_path / "m.svg").stat().st_size > 1000


def test_reasons_name_blended_lines_by_the_waypoints_of_the_file(beeline, tmp_path):
    (tmp_path / "w.csv").write_text("x,y,theta\n4.5,5.2,0\n2,6,45\n2,30,45\n")
    path = ("--degrees", "--through", "w.csv", "--blend", "0.1")
    from_start = beeline("line", "rrr", "--from", "0,90,0", *path)
    assert from_start.code == 1 and "line 3 of 3 (waypoint 2 to 3) stops after" in from_start.err
    from_first = beeline("line", "rrr", *path)
    assert from_first.code == 1 and "line 2 of 2 (waypoint 2 to 3) stops after" in from_first.err
    (tmp_path / "w.csv").write_text("x,y,theta\n4.5,5.2,0\n2,6,45\n5,3,-20\n")
    made = beeline("line", "rrr", "--from", "0,90,0", *path, "--out", "m.csv")
    assert made.code == 0, made.err
    sharp = beeline("check", "rrr", "m.csv", *path[:3], "--blend", "0.2")
    assert sharp.code == 1 and "the blend at waypoint 2" in sharp.err
