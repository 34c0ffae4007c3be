"""ik: every status, each with a pose that has exactly that cause; the forms of the answer."""

import json
import math

import pytest

from arms import Q, joints, text


def test_both_elbows_of_the_chapters_arm(beeline, ik):
    goal = beeline("fk", "rrr", "--q", "99.2,-68.8,-30.4", "--degrees", "--json").json
    planar = goal["pose"]["planar"]
    pose = text(planar[key] for key in ("x", "y", "theta"))
    answer = ik("rrr", pose, "--all", "--degrees")
    assert answer["status"] == "solved" and len(answer["solutions"]) == 2
    near = min(
        max(abs(math.remainder(a - b, 360)) for a, b in zip(q, (99.2, -68.8, -30.4)))
        for q in answer["solutions"]
    )
    assert near < 1e-6 and answer["residual"] < 1e-9


@pytest.mark.parametrize("options", [(), ("--all",), ("--method", "numerical")], ids=" ".join)
@pytest.mark.parametrize("arm", Q)
def test_what_ik_returns_reaches_the_pose(beeline, ik, matrix, pose_at, arm, options):
    answer = ik(arm, pose_at(arm, Q[arm]), *options)
    assert answer["status"] == "solved" and not answer["singular"]
    assert answer["method"].startswith("numerical" if "numerical" in options else "closed form: ")
    for q in answer["solutions"][:12]:
        there = beeline("fk", arm, "--q", text(q), "--json")
        assert there.err == ""  # within limits
        assert matrix(arm, text(q)) == pytest.approx(matrix(arm, Q[arm]), abs=1e-8)


def test_solutions_come_by_their_distance_from_the_seed(ik, pose_at):
    seed = "0.5,-0.8,0.9,0.1,1,0.3"
    solutions = ik("ur5", pose_at("ur5", Q["ur5"]), "--all", "--seed", seed)["solutions"]
    assert len(solutions) == 8
    far = [math.dist(q, joints(seed)) for q in solutions]
    assert far == sorted(far) and math.dist(solutions[0], joints(Q["ur5"])) < 1e-8


def test_the_json_documents_keys_and_their_order(beeline):
    keys = ["status", "solutions", "singular", "complete", "branches_complete", "self_motion_dimension", "grid", "deviation", "residual",
            "reason", "nearest", "method", "iterations", "restarts", "code", "fields", "units"]
    for pose in ("4,5,0", "8,8,0"):
        assert list(beeline("ik", "rrr", "--pose", pose, "--json").json) == keys


def test_all_solutions_of_a_redundant_arm_say_at_which_values_of_a_joint(ik, pose_at):
    answer = ik("panda", pose_at("panda", Q["panda"]), "--all", "--grid", "9", "--degrees")
    grid = answer["grid"]
    assert grid["joint"] == "joint7" and len(grid["values"]) == 9 and not answer["complete"]
    assert set(grid["complete"]) <= set(grid["values"])
    assert max(grid["values"]) == pytest.approx(math.degrees(2.8973))
    for q in answer["solutions"]:
        assert min(abs(q[6] - value) for value in grid["values"]) < 1e-6


def test_a_tolerance_of_the_pose_reports_the_deviation(ik):
    tolerance = ["--pose-tolerance", "0.1,0.1,60", "--degrees"]
    answer = ik("rrr", "6.4,6.4,0", *tolerance)
    assert answer["status"] == "solved" and answer["residual"] < 1e-9
    x, y, theta = answer["deviation"]
    assert max(abs(x), abs(y)) <= 0.1 and 0 < theta <= 60
    assert ik("rrr", "4,5,0", *tolerance)["deviation"] is None
    refused = ik("rrr", "8,8,0", *tolerance)
    assert refused["status"] == "unreachable" and "pose tolerance" in refused["reason"]


def test_weights_order_the_solutions(ik, pose_at):
    seed, weights = joints("0.5,-0.8,0.9,0.1,1,0.3"), [100, 1, 1, 1, 0.01, 1]
    answer = ik("ur5", pose_at("ur5", Q["ur5"]), "--all", "--seed", text(seed), "--weights", text(weights))
    far = [sum(w * (a - b) ** 2 for w, a, b in zip(weights, q, seed)) for q in answer["solutions"]]
    assert len(far) == 8 and far == sorted(far)


def test_unreachable_says_by_how_much_and_where_the_arm_comes_nearest(ik, matrix):
    answer = ik("rrr", "8,8,0", "--degrees")
    beyond = math.hypot(8, 8) - 9
    assert answer["status"] == "unreachable" and f"{beyond:.6g} m" in answer["reason"]
    assert answer["residual"] == pytest.approx(beyond)
    nearest = answer["nearest"]
    assert list(nearest) == ["q", "pose", "position_error", "orientation_error"]
    assert nearest["position_error"] == pytest.approx(beyond)
    assert nearest["pose"]["planar"] == pytest.approx(
        {"x": 9 / math.sqrt(2), "y": 9 / math.sqrt(2), "theta": 45}, abs=1e-6)
    assert nearest["orientation_error"] == pytest.approx(45, abs=1e-6)
    q = text(math.radians(value) for value in nearest["q"])
    assert matrix("rrr", q) == pytest.approx(sum(nearest["pose"]["matrix"], []), abs=1e-12)


@pytest.mark.parametrize("arm, pose, missing", [
    ("puma560", "0.01,0,0,0,0,0", 0.15005 - 0.01),  # nearer to the axis than the shoulder's offset
    ("iiwa14", "0,0,2,0,0,0", 2 - 0.36 - 0.42 - 0.4 - 0.126),
    ("scara", "0.7,0,0.3,3.141592653589793,0,0", 0.7 - 0.325 - 0.275),
])
def test_unreachable_in_space(ik, arm, pose, missing):
    answer = ik(arm, pose)
    assert answer["status"] == "unreachable"
    assert answer["residual"] == answer["nearest"]["position_error"]
    assert answer["residual"] == pytest.approx(missing, abs=1e-6)
    x, y, z = answer["nearest"]["pose"]["translation"]
    goal = joints(pose)[:3]
    assert math.dist((x, y, z), goal) == pytest.approx(missing, abs=1e-6)


def test_orientation_says_how_much_turn_is_missing(ik):
    # The wrist of the pose at (-7, 0) would be at (-9, 0), 2 m out of its reach. The triangle
    # of sides 7 (wrist), 2 (hand) and 7 (tool) has the turn that brings it to the edge.
    least = math.acos((7 * 7 - 7 * 7 - 2 * 2) / (2 * 7 * 2))
    for unit, options in ((1, ()), (180 / math.pi, ("--degrees",))):
        answer = ik("rrr", "-7,0,0", *options)
        assert answer["status"] == "orientation_unreachable"
        # The search comes slowly to an arm that is stretched, but never below.
        assert -1e-9 < answer["residual"] / unit - least < 2e-3
        assert answer["nearest"]["orientation_error"] == pytest.approx(answer["residual"])
        assert answer["nearest"]["position_error"] < 1e-9


def test_orientation_where_every_axis_is_vertical(ik):
    answer = ik("scara", "0.4,0.1,0.3,150,0,0", "--degrees")  # the tool hangs at roll 180
    assert answer["status"] == "orientation_unreachable" and "tilted" in answer["reason"]
    assert answer["residual"] == pytest.approx(30)
    anyhow = ik("scara", "0.4,0.1,0.3,150,0,0", "--degrees", "--task", "position")
    assert anyhow["status"] == "solved"


def test_outside_limits_names_the_joint_and_the_excess(ik, written):
    joint = {"name": "a", "type": "revolute", "limits": {"lower": -0.5, "upper": 0.5}}
    arm = {"name": "stiff", "joints": [joint], "tool": {"xyz": [1, 0, 0]}}
    stiff = written("stiff.json", json.dumps(arm))
    pose = text([math.cos(1), math.sin(1), 1])
    answer = ik(stiff, pose)
    assert answer["status"] == "outside_limits" and " a " in answer["reason"]
    nearest = answer["nearest"]
    assert nearest["q"] == pytest.approx([1]) and nearest["joint"] == "a"
    assert nearest["excess"] == answer["residual"] == pytest.approx(0.5)
    assert nearest["position_error"] < 1e-9 and nearest["orientation_error"] < 1e-9
    free = ik(stiff, pose, "--ignore-limits")
    assert free["solutions"][0] == pytest.approx([1])


def test_an_excess_is_in_the_joints_own_unit(ik, beeline, written, pose_at, tmp_path):
    slide = ik("stanford", "3,0,0,0,0,0", "--degrees")  # too far for its slide alone
    assert slide["status"] == "outside_limits" and slide["nearest"]["joint"] == "joint3"
    assert slide["nearest"]["excess"] == pytest.approx(slide["nearest"]["q"][2] - 1.27)
    assert slide["residual"] == slide["nearest"]["excess"]
    # A puma whose elbow is nearly locked: joint 3 settles how far the wrist is from the shoulder.
    beeline("show", "puma560", "--out", "puma.json")
    arm = json.loads((tmp_path / "puma.json").read_text())
    arm["joints"][2]["limits"] = {"lower": -1.6, "upper": -1.5}
    stiff = written("stiff.json", json.dumps(arm))
    pose = pose_at("puma560", "0.3,1,-1,0.4,0.8,0.2")
    for unit, options in ((1, ()), (180 / math.pi, ("--degrees",))):
        answer = ik(stiff, pose, *options)
        assert answer["status"] == "outside_limits"
        nearest = answer["nearest"]
        assert nearest["joint"] == "joint3"
        value = nearest["q"][2] / unit  # of either elbow
        assert nearest["excess"] == pytest.approx(unit * max(-1.6 - value, value + 1.5))
        assert 0 < nearest["excess"] == answer["residual"] < 0.501 * unit


def test_a_search_that_the_budget_ended_claims_nothing(ik, pose_at):
    answer = ik("panda", pose_at("panda", Q["panda"]), "--method", "numerical", "--max-restarts", "0",
                "--max-iterations", "1", "--time-limit", "1e-9")
    assert answer["status"] == "time_limit" and answer["restarts"] == 0
    assert "time limit" in answer["reason"] and "before a solution was found" in answer["reason"]
    assert answer["residual"] > 0 and answer["nearest"] is not None


@pytest.mark.parametrize("arm, q, step", [
    ("puma560", "0.3,1,-1,0.4,0,0.2", "0,0,0,0.3,0,-0.3"),  # axes 4 and 6 in one line
    ("stanford", "0.3,1,0.5,0.4,0,0.2", "0,0,0,0.3,0,-0.3"),
    ("iiwa14", "0,0,0,0,0,0,0", "0.3,0,-0.3,0,0,0,0"),  # stretched upwards
])
def test_singular_solutions_stand_for_infinitely_many(ik, beeline, matrix, pose_at, arm, q, step):
    moved = text(a + b for a, b in zip(joints(q), joints(step)))
    assert matrix(arm, moved) == pytest.approx(matrix(arm, q), abs=1e-12)
    pose = pose_at(arm, q)
    answer = ik(arm, pose, "--all")
    assert answer["status"] == "solved" and answer["singular"]
    assert "infinitely many" in answer["reason"]
    printed = beeline("ik", arm, "--pose", pose, "--all")
    assert printed.code == 0 and printed.err == "" and answer["reason"] in printed.out


def test_what_a_person_reads(beeline):
    far = beeline("ik", "rrr", "--pose", "8,0,0", "--task", "position", "--seed", "0,1,0").out
    assert far.startswith("solved: 1 solution by ")
    lines = beeline("ik", "rrr", "--pose", "10,0,90", "--degrees").out.splitlines()
    assert lines[0].startswith("unreachable: 0 solutions by ")
    assert lines[0].endswith("residual 1 m")
    assert lines[1].startswith("  nearest: q ") and "; tool at 9, " in lines[1]
    turned = beeline("ik", "scara", "--pose", "0.4,0.1,0.3,150,0,0", "--degrees").out
    assert turned.splitlines()[0].endswith("residual 30 deg")
    slide = beeline("ik", "stanford", "--pose", "3,0,0,0,0,0", "--degrees").out
    assert slide.splitlines()[0].endswith(" m")


def test_infinitely_many_solutions_are_said_to_be_so_and_listed_in_a_readable_number(beeline, pose_at):
    pose = "--pose=" + pose_at("panda", Q["panda"])
    data = beeline("ik", "panda", pose, "--all", "--json").json
    assert data["self_motion_dimension"] == 1 and len(data["solutions"]) > 20
    lines = beeline("ik", "panda", pose, "--all").out.splitlines()
    assert lines[0].startswith("solved: infinitely many solutions (self-motion of dimension 1), "
                               f"{len(data['solutions'])} samples")
    assert len(lines) == 1 + 10 + 2
    assert lines[11].split() == ["and", str(len(data["solutions"]) - 10), "more,", "which", "--json", "prints"]
    assert "--lock joint7=VALUE" in lines[12] and "--redundancy" in lines[12]
    locked = beeline("ik", "panda", pose, "--all", "--lock", f"joint7={joints(Q['panda'])[6]}")
    assert locked.out.startswith("solved: ") and "infinitely" not in locked.out and len(locked.out.splitlines()) < 10
    for arm in ("rrr", "ur5"):
        finite = beeline("ik", arm, "--pose=" + pose_at(arm, Q[arm]), "--all")
        count = int(finite.out.split()[1])
        assert "infinitely" not in finite.out and len(finite.out.splitlines()) == 1 + count
