"""check: passes what line makes, and reports each fault planted in it, with its sample."""

import csv
import math

import pytest

from profiles import PROFILES

STARTS = {"ur5": "0.2,-1.2,1.5,-0.5,1.2,0", "puma560": "0.2,-0.6,0.3,0.4,0.7,0",
          "panda": "0,0.3,0,-1.6,0,1.2,0.785", "rrr": "1.0,-0.9,0.4"}


@pytest.fixture
def lines(beeline, written):
    """The file of poses for an arm: from STARTS over two others."""

    def poses(arm):
        pose = beeline("fk", arm, "--q", STARTS[arm], "--json").json["pose"]
        if "planar" in pose:
            x, y, theta = (pose["planar"][key] for key in ("x", "y", "theta"))
            rows = [(x, y, theta), (x - 0.5, y + 0.4, theta + 0.3), (x + 0.2, y - 0.3, theta)]
            return written(f"{arm}.csv", "x,y,theta\n" + "".join(f"{a},{b},{c}\n" for a, b, c in rows))
        x, y, z = pose["translation"]
        quaternion = [pose["quaternion"][key] for key in ("qw", "qx", "qy", "qz")]
        turn = ",".join(map(repr, quaternion))
        rows = [(x, y, z), (x + 0.05, y + 0.1, z - 0.08), (x - 0.06, y + 0.02, z + 0.05)]
        text = "".join(f"{a!r},{b!r},{c!r},{turn}\n" for a, b, c in rows)
        return written(f"{arm}.csv", "x,y,z,qw,qx,qy,qz\n" + text)

    return poses


@pytest.fixture
def made(beeline, lines, tmp_path):
    """made("ur5", "--profile", "quintic") -> the file of poses and the rows of the motion."""

    def make(arm, *options):
        through = lines(arm)
        answer = beeline("line", arm, "--through", through, "--out", "move.csv", *options)
        assert answer.code == 0, answer.err
        with open(tmp_path / "move.csv") as file:
            return through, list(csv.DictReader(file))

    return make


@pytest.fixture
def checked(beeline, tmp_path):
    """checked(rows, arm, through) -> the report on rows, written to a file."""

    def write_and_check(rows, arm, through, code=1):
        with open(tmp_path / "planted.csv", "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)
        answer = beeline("check", arm, "planted.csv", "--through", through, "--json")
        assert answer.code == code, answer.out + answer.err
        return answer.json if code < 2 else answer.err

    return write_and_check


def shift(rows, first, joint, by):
    for row in rows[first:]:
        row[joint] = repr(float(row[joint]) + by)


@pytest.mark.parametrize("arm", STARTS)
@pytest.mark.parametrize("profile", [profile for profile in PROFILES if profile != "jerk"])
@pytest.mark.parametrize("rate", [(), ("--rate", "250")])
def test_what_line_makes_passes(beeline, made, arm, profile, rate):
    through, rows = made(arm, "--profile", profile, *rate)
    report = beeline("check", arm, "move.csv", "--through", through, "--json").json
    if arm == "panda" and profile in ("fastest", "trapezoidal"):  # they do not keep its jerk limits
        assert report["fault"] in (None, "jerk")
        return
    assert report["status"] == "passed", report["reason"]
    assert report["samples"] == len(rows)
    assert report["deviation_sampled"] <= report["deviation_bound"] <= 1e-4
    assert report["arrivals"][0] == 1 and report["arrivals"][-1] == len(rows)


@pytest.mark.parametrize("arm", STARTS)
def test_a_motion_from_given_joints_passes(beeline, lines, arm):
    through = lines(arm)
    answer = beeline("line", arm, "--from", STARTS[arm], "--through", through, "--out", "m.json")
    assert answer.code == 0, answer.err
    report = beeline("check", arm, "m.json", "--through", through, "--json").json
    assert report["status"] == "passed", report["reason"]


@pytest.mark.parametrize("arm", ["ur5", "panda"])
@pytest.mark.parametrize("rate", [(), ("--rate", "250")])
def test_one_sample_moved_by_a_fifth_of_a_millimetre_is_found(beeline, made, checked, arm, rate):
    through, rows = made(arm, *rate, "--profile", "quintic")
    k = len(rows) // 3
    q = [float(rows[k][f"joint{i}"]) for i in range(1, len(STARTS[arm].split(",")) + 1)]

    def position(q):
        return beeline("fk", arm, "--q", ",".join(map(repr, q)), "--json").json["pose"]["translation"]

    moved = math.dist(position(q), position([q[0] + 1e-3, *q[1:]]))
    rows[k]["joint1"] = repr(q[0] + 2e-4 * 1e-3 / moved)
    report = checked(rows, arm, through)
    assert k - 3 <= report["sample"] <= k + 2
    assert f"sample {report['sample']}" in report["reason"]


@pytest.mark.parametrize("arm", ["ur5", "puma560"])
def test_a_jump_by_a_whole_turn_is_found(made, checked, arm):
    through, rows = made(arm)
    half = len(rows) // 2
    shift(rows, half, "joint6", -2 * math.pi if float(rows[half]["joint6"]) > 0 else 2 * math.pi)
    report = checked(rows, arm, through)
    assert report["fault"] == "flip" and report["sample"] == half


def test_a_change_of_branch_is_found(beeline, made, checked, pose_at):
    through, rows = made("ur5")
    half = len(rows) // 2
    for row in rows[half:]:
        q = ",".join(row[f"joint{i}"] for i in range(1, 7))
        answer = beeline("ik", "ur5", f"--pose={pose_at('ur5', q)}", f"--seed={q}", "--all", "--json")
        other = answer.json["solutions"][1]
        row.update({f"joint{i + 1}": repr(value) for i, value in enumerate(other)})
    report = checked(rows, "ur5", through)
    assert report["sample"] == half and report["fault"] in ("flip", "deviation")


def test_a_limit_exceeded_only_between_samples_is_found(beeline, made, checked):
    through, rows = made("panda")
    k = len(rows) // 2
    top = 3.0 + float(rows[k]["t"]) - float(rows[k - 1]["t"])
    rows[k]["joint2_vel"] = repr(1e3 * top)
    report = checked(rows, "panda", through)
    assert report["fault"] in ("limits", "deviation") and report["sample"] in (k - 1, k, k + 1)
    assert "next sample" in report["reason"]


def test_a_motion_that_is_too_fast_is_found(made, checked):
    through, rows = made("panda")
    for row in rows:
        row["t"] = repr(0.9 * float(row["t"]))
    assert checked(rows, "panda", through)["fault"] in ("velocity", "acceleration", "jerk")


def columns(rows, ending):
    return [name for name in rows[0] if name.endswith(ending)]


def pause(rows):
    """The motion stands still for a second in full motion."""
    k = len(rows) // 4
    again = dict(rows[k])
    later = [{**row, "t": repr(float(row["t"]) + 1)} for row in [again, *rows[k + 1:]]]
    return [*rows[:k + 1], *later]


def pause_at_rest(rows):
    rows = pause(rows)
    for row in rows[(len(rows) - 1) // 4:(len(rows) - 1) // 4 + 2]:
        row.update({name: "0" for name in columns(rows, "_vel") + columns(rows, "_acc")})
    return rows


def cut(rows):
    first = len(rows) // 3
    return [{**row, "t": repr(float(row["t"]) - float(rows[first]["t"]))} for row in rows[first:]]


def without_velocities(rows):
    return [{**row, **{name: "0" for name in columns(rows, "_vel")}} for row in rows]


def doubled_velocities(rows):
    return [{**row, **{name: repr(2 * float(row[name])) for name in columns(rows, "_vel")}}
            for row in rows]


def opposite_accelerations(rows):
    return [{**row, **{name: repr(-float(row[name])) for name in columns(rows, "_acc")}}
            for row in rows]


@pytest.mark.parametrize("arm", STARTS)
@pytest.mark.parametrize("rate", [(), ("--rate", "100")])
@pytest.mark.parametrize("fault", [pause, pause_at_rest, cut, without_velocities, doubled_velocities,
                                   opposite_accelerations])
def test_planted_faults_are_found_without_known_accelerations(made, checked, arm, rate, fault):
    through, rows = made(arm, *rate)
    report = checked(fault(rows), arm, through)
    assert report["status"] == "failed"


def test_an_assumed_limit_is_named_with_the_cure(beeline, made):
    through, _ = made("ur5")
    answer = beeline("check", "ur5", "move.csv", "--through", through, "--speed", "0.9", "--json")
    assert answer.code == 1 and answer.json["fault"] in ("velocity", "acceleration")
    through, _ = made("ur5", "--acceleration", "20")
    answer = beeline("check", "ur5", "move.csv", "--through", through, "--json")
    assert answer.code == 1 and answer.json["fault"] == "acceleration"
    assert "assumed" in answer.err and "--acceleration" in answer.err
    answer = beeline("check", "ur5", "move.csv", "--through", through, "--acceleration", "20")
    assert answer.code == 0, answer.err


def test_files_without_a_trajectory_are_refused(made, checked):
    through, rows = made("ur5")
    rows[4]["t"] = rows[3]["t"]
    assert "planted.csv" in checked(rows, "ur5", through, code=3)
    through, rows = made("ur5")
    renamed = [{key.replace("joint3", "elbow"): row[key] for key in row} for row in rows]
    refusal = checked(renamed, "ur5", through, code=3)
    assert "elbow" in refusal and len(refusal.strip().splitlines()) == 1


@pytest.mark.parametrize("verb, options", [
    ("check", ()), ("replay", ()), ("retime", ()), ("export", ("--as", "ros2", "--out", "a.yaml"))])
def test_poses_are_no_trajectory(refused, written, verb, options):
    poses = written("poses.csv", "x,y,theta\n4,5,0\n")
    refused(3, verb, "rrr", poses, *options, says=["has poses of the tool, x, y, theta", "joint1", "--through", "batch ik"])
    if verb == "export":  # which takes programs
        return
    program = written("pick.csv", "motion,x,y,theta\nline,4,5,0\n")
    refused(3, verb, "rrr", program, *options, says=["is a program", "joint1", "--through"])


def test_a_tolerance_that_is_not_positive_is_refused(beeline, made):
    through, _ = made("rrr")
    for bad in ("0", "-1", "nan"):
        answer = beeline("check", "rrr", "move.csv", "--through", through, f"--tolerance={bad}")
        assert answer.code == 2 and len(answer.err.strip().splitlines()) == 1, answer.err


@pytest.mark.parametrize("arm", ["ur5", "panda", "rrr"])
@pytest.mark.parametrize("path", [["--path", "screw"], ["--path", "arc"], ["--path", "spline"], ["--blend", "0.02"]])
@pytest.mark.parametrize("rate", [[], ["--rate", "500"]])
def test_every_kind_of_path_is_checked_as_it_was_made(beeline, made, checked, arm, path, rate):
    if arm == "rrr" and rate:
        rate = ["--rate", "100"]
    through, rows = made(arm, "--from", STARTS[arm], "--profile", "quintic", *path, *rate)
    # the first pose of the file is the pose of the arm, and counts once
    answer = beeline("check", arm, "move.csv", "--through", through, "--json", *path, "--plot", "check.svg")
    assert answer.code == 0, answer.err
    assert answer.json["deviation_bound"] <= 1e-4
    if path[1] != "screw" or arm == "rrr":  # on the other paths the orientation is not constant
        assert beeline("check", arm, "move.csv", "--through", through).code == 1  # not straight lines
    rows[len(rows) // 2]["joint1"] = "0.5"
    checked(rows, arm, through)


def test_a_spline_with_a_cusp_is_checked_as_it_was_made(beeline, written):
    through = written("cusp.csv", "x,y,theta\n-1.4895142267148835,4.81329077278462,-2.53606536542102\n"
                      "-0.4525992402916854,5.263021343141883,-2.6530539926860275\n"
                      "-1.916881271558655,5.398356481921038,-2.601943275426942\n"
                      "-4.273440145485141,4.136672138006768,-2.340825837545646\n")
    path = ("--through", through, "--path", "spline", "--tolerance", "1e-3")
    start = "0.5163193671107278,0.6510234143033649,1.2485277069274998"
    for rate in ([], ["--rate", "50"]):
        made = beeline("line", "rrr", "--from", start, *path, "--tool-speed", "0.1", *rate, "--out", "move.csv")
        assert made.code == 0, made.err
        answer = beeline("check", "rrr", "move.csv", *path)
        assert answer.code == 0, answer.err


def test_branches_are_listed_along_every_kind_of_path(beeline, lines):
    for path in (["--path", "screw"], ["--path", "spline"], ["--blend", "0.02"]):
        answer = beeline("line", "ur5", "--through", lines("ur5"), "--branches", "--json", *path)
        assert answer.code == 0, answer.err
        assert len(answer.json["branches"]) == 8
        assert {branch["path_parameter"] for branch in answer.json["branches"]} <= {2.0, 3.0}


@pytest.mark.parametrize("off", [0, 2e-9, 5e-6, 1e-3])
@pytest.mark.parametrize("path", [["--path", "spline"], ["--blend", "0.01"]])
def test_a_start_near_the_first_pose_means_the_same_to_line_and_check(
        beeline, lines, written, tmp_path, off, path):
    rows = (tmp_path / lines("ur5")).read_text().splitlines()
    x, rest = rows[1].split(",", 1)
    through = written("beside.csv", "\n".join([rows[0], f"{float(x) + off!r},{rest}", *rows[2:]]))
    made = beeline("line", "ur5", "--from", STARTS["ur5"], "--through", through, "--out", "move.csv", *path)
    assert made.code == 0, made.err
    answer = beeline("check", "ur5", "move.csv", "--through", through, *path)
    assert answer.code == 0, answer.err


def test_every_kind_of_fault_is_listed_with_its_first_place_and_the_worst(beeline, made, written):
    through, rows = made("ur5", "--profile", "quintic")
    for row in rows:
        for name in list(row):
            if name.endswith(("_vel", "_acc")):
                del row[name]
    first, worst = len(rows) // 3, len(rows) // 2
    rows[first]["joint1"] = repr(float(rows[first]["joint1"]) + 0.01)
    rows[worst]["joint2"] = repr(7.0)  # beyond 2 pi
    text = ",".join(rows[0]) + "\n" + "".join(",".join(row.values()) + "\n" for row in rows)
    report = beeline("check", "ur5", written("bad.csv", text), "--through", through, "--json").json
    faults = {fault["fault"]: fault for fault in report["faults"]}
    assert report["faults"][0]["fault"] == report["fault"]
    assert {"limits", "flip", "deviation", "velocity", "acceleration"} <= set(faults)
    limits = faults["limits"]
    assert limits["sample"] == worst + 1 and limits["first"] == limits["worst"]
    assert limits["amount"] == pytest.approx(7 - 2 * math.pi)
    assert limits["worst"]["fields"]["joint"] == "joint2"
    assert faults["deviation"]["sample"] <= first + 1
    assert faults["deviation"]["worst"]["fields"]["sample"] == worst + 1
    assert faults["deviation"]["worst"]["fields"]["distance"] > faults["deviation"]["first"]["fields"]["distance"]
    text = beeline("check", "ur5", "bad.csv", "--through", through).out
    assert text.count("\nfault ") == len(faults)
    assert "\nposition      at most 111" in text and " of the half range, joint joint2 at " in text


def test_positions_have_a_row(beeline, made):
    through, _ = made("ur5")
    answer = beeline("check", "ur5", "move.csv", "--through", through)
    assert answer.code == 0 and "\nposition      at most " in answer.out
    usage = beeline("check", "ur5", "move.csv", "--through", through, "--json").json["limits"]["position"]
    assert 0 < usage["fraction"] <= 1 and usage["exact"]
    through, _ = made("rrr")
    assert "\nposition      no joint has position limits\n" in beeline("check", "rrr", "move.csv", "--through", through).out


def test_without_poses_the_limits_are_checked_and_the_answer_says_what_is_not(beeline, made):
    made("ur5")
    answer = beeline("check", "ur5", "move.csv")
    assert answer.code == 0 and answer.out.startswith("passed: ")
    assert "\nnot checked   the tool's path: --through FILE gives its poses; collisions: --scene FILE" in answer.out
    report = beeline("check", "ur5", "move.csv", "--json").json
    assert report["checked"] == ["limits"] and report["deviation_bound"] is None
    slow = beeline("check", "ur5", "move.csv", "--velocity", "0.1", "--json")
    assert slow.code == 1 and "velocity" in {fault["fault"] for fault in slow.json["faults"]}


def test_waypoints_have_the_numbers_of_the_file_with_and_without_a_start(beeline, lines, written, tmp_path):
    with open(tmp_path / lines("ur5")) as file:
        rows = file.read().splitlines()
    far = written("far.csv", "\n".join([*rows[:3], "9" + rows[3][rows[3].index(","):]]) + "\n")
    for start in ([], ["--from", STARTS["ur5"]]):
        answer = beeline("line", "ur5", *start, "--through", far, "--json")
        assert answer.code == 1 and "(waypoint 2 to 3) stops after" in answer.json["reason"]


def test_quickest_joint_moves_report_limits_that_are_assumed(beeline):
    move = ("move", "ur5", "--from", "0,0,0,0,0,0", "--to", "1,1,1,0,0,0", "--method", "quickest")
    text, report = beeline(*move).out, beeline(*move, "--json").json
    assert "of the assumed limit" in text and report["limits"]["acceleration"]["assumed"]
    assert 0.5 < max(use["fraction"] for use in report["limits"].values() if use) <= 1 + 1e-6
    controlled = beeline(*move[:-1], "feedback", "--json").json
    assert controlled["limits"]["acceleration"]["assumed"] and not controlled["start_jump"]["assumed"]
