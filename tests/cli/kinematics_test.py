"""fk, jacobian, arms, show: the chapter's numbers, the documented JSON, the warnings."""

import math

import pytest


@pytest.mark.parametrize(
    "q, pose",
    [
        ("112,-52,-60", (2.43888, 6.27623, 0)),
        ("60,-45,-90", (5.64838, 2.00510, -75)),
        ("99.2,-68.8,-30.4", (4.459, 5.226, 0)),
    ],
)
@pytest.mark.parametrize("arm", ["rrr", "RRR:3.5,3.5,2"])
def test_the_chapters_poses(beeline, arm, q, pose):
    answer = beeline("fk", arm, "--q", q, "--degrees", "--json")
    planar = answer.json["pose"]["planar"]
    precision = 1e-5 if pose[0] != 4.459 else 5e-4
    for key, value in zip(("x", "y", "theta"), pose):
        assert planar[key] == pytest.approx(value, abs=precision)
    assert answer.code == 0 and answer.err == ""


def test_the_exercise_rp_pose_for_any_q(beeline):
    for theta, d in [(0.3, 0.5), (-2, 1.7), (1, -0.25)]:
        pose = beeline("fk", "rp", "--q", f"{theta},{d}", "--json").json["pose"]["planar"]
        assert pose["x"] == pytest.approx((1 + d) * math.cos(theta), abs=1e-12)
        assert pose["y"] == pytest.approx((1 + d) * math.sin(theta), abs=1e-12)
        assert pose["theta"] == pytest.approx(theta, abs=1e-12)


def test_fk_json_has_the_documented_keys(beeline):
    pose = beeline("fk", "panda", "--q", "0,0,0,-1,0,1,0", "--json").json["pose"]
    assert set(pose) == {"matrix", "translation", "quaternion"}
    assert [len(row) for row in pose["matrix"]] == [4, 4, 4, 4]
    assert set(pose["quaternion"]) == {"qw", "qx", "qy", "qz"}
    links = beeline("fk", "panda", "--q", "0,0,0,-1,0,1,0", "--json", "--all").json["links"]
    assert len(links) == 8 and links[0]["link"] == "base"


def test_a_slide_is_in_metres_also_with_degrees(beeline):
    pose = beeline("fk", "rp", "--q", "90,0.5", "--degrees", "--json").json["pose"]["planar"]
    assert pose["y"] == pytest.approx(1.5) and pose["theta"] == pytest.approx(90)


def test_outside_limits_is_a_warning_for_fk_and_jacobian(beeline):
    for verb in ("fk", "jacobian"):
        answer = beeline(verb, "panda", "--q", "0,0,0,0,0,0,0", "--json")
        assert answer.code == 0 and answer.json
        assert "warning" in answer.err and "joint4" in answer.err


def test_the_chapters_jacobian(beeline):
    answer = beeline("jacobian", "rrr", "--q", "0,90,0", "--degrees", "--json").json
    assert answer["frame"] == "base" and answer["rows"] == ["x", "y", "theta"]
    columns = list(zip(*answer["jacobian"]))
    for column, expected in zip(columns, [(-5.5, 3.5, 1), (-5.5, 0, 1), (-2, 0, 1)]):
        assert column == pytest.approx(expected, abs=1e-12)
    assert answer["jacobian"][2] == [1, 1, 1]  # exactly
    assert answer["manipulability"] == pytest.approx(math.prod(answer["singular_values"]))


def test_a_singular_jacobian_has_no_number_that_json_lacks(beeline):
    answer = beeline("jacobian", "rrr", "--q", "0,0,0", "--json").json
    assert answer["condition"] is None and answer["manipulability"] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("frame", ["base", "tool", "space"])
def test_jacobian_names_its_frame_and_rows(beeline, frame):
    answer = beeline("jacobian", "ur5", "--q", "1,2,3,4,5,6", "--frame", frame, "--json").json
    assert answer["frame"] == frame
    assert answer["rows"] == ["vx", "vy", "vz", "wx", "wy", "wz"]
    spoken = beeline("jacobian", "ur5", "--q", "1,2,3,4,5,6", "--frame", frame).out
    assert frame in spoken.splitlines()[0]


def test_arms_lists_what_the_design_names(beeline):
    names = {arm["name"] for arm in beeline("arms", "--json").json["arms"]}
    assert names >= {"rrr", "rp", "gantry", "puma560", "ur5", "ur5e", "panda", "iiwa14", "scara",
                     "stanford"}
    for name in names:
        assert beeline("show", name).code == 0


def test_show_writes_an_arm_that_reads_back(beeline, tmp_path):
    assert beeline("show", "panda", "--out", "panda.json").code == 0
    q = "0.1,0.2,-0.3,-1.4,0.5,1.6,0.7"
    there = beeline("fk", "panda", "--q", q, "--json").json
    back = beeline("fk", "panda.json", "--q", q, "--json").json
    for a, b in zip(sum(there["pose"]["matrix"], []), sum(back["pose"]["matrix"], [])):
        assert a == pytest.approx(b, abs=1e-14)
    assert beeline("show", "panda.json", "--json").json["joints"][3]["limits"]["upper"] == -0.0698
