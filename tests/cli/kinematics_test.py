"""fk, jacobian, arms, show: the chapter's numbers, the documented JSON, the warnings."""

import math

import numpy as np

import pytest

from arms import text


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


UR5E = ("ur5e", "--q", "0,-1.2,1.3,-1.5,-1.4,0.4")


@pytest.mark.parametrize("frame", ["base", "tool", "space"])
def test_derivatives_are_the_difference_quotients(beeline, frame):
    q, dq, ddq, h = np.array([0, -1.2, 1.3, -1.5, -1.4, 0.4]), np.array([1, 0, 0.5, -1, 0.2, 0.3]), np.arange(6) / 5, 1e-5

    def jacobian(q):
        return np.array(beeline("jacobian", "ur5e", "--q=" + text(q), "--frame", frame, "--json").json["jacobian"])

    found = beeline("jacobian", *UR5E, "--frame", frame, "--derivative=" + text(dq), "--second-derivative=" + text(ddq),
                    "--hessian", "--json").json
    numeric = (jacobian(q + h * dq) - jacobian(q - h * dq)) / (2 * h)
    assert np.allclose(found["derivative"], numeric, atol=1e-8)
    assert np.allclose(found["velocity"], jacobian(q) @ dq, atol=1e-14)
    assert np.allclose(found["acceleration"], jacobian(q) @ ddq + found["derivative"] @ dq, atol=1e-13)
    assert np.allclose(np.tensordot(dq, np.array(found["hessian"]), 1), found["derivative"], atol=1e-13)


def test_analytical_gradient_ellipsoids_and_torques(beeline):
    found = beeline("jacobian", *UR5E, "--analytical", "rpy", "--gradient", "--ellipsoids", "--wrench", "1,2,-10,0.1,0,3",
                    "--json").json
    jacobian = np.array(found["jacobian"])
    assert found["analytical"]["rows"] == ["x", "y", "z", "roll", "pitch", "yaw"]
    assert np.allclose(np.array(found["analytical"]["jacobian"])[:3], jacobian[:3], atol=1e-14)
    assert np.allclose(found["torques"], jacobian.T @ [1, 2, -10, 0.1, 0, 3], atol=1e-12)
    values = np.linalg.svd(jacobian[:3])[1]
    assert np.allclose(found["ellipsoids"]["velocity"], values) and np.allclose(found["ellipsoids"]["force"], 1 / values)
    assert found["manipulability_translational"] == pytest.approx(np.prod(values))
    assert found["manipulability_rotational"] == pytest.approx(np.prod(np.linalg.svd(jacobian[3:])[1]))
    assert len(found["manipulability_gradient"]) == 6


def test_manipulability_of_an_arm_with_fewer_joints_than_rows(beeline):
    answer = beeline("jacobian", "gantry", "--q", "1,2", "--ellipsoids", "--json")
    assert answer.json["manipulability"] == 0 and answer.json["manipulability_translational"] == pytest.approx(1)
    assert answer.json["ellipsoids"]["rows"] == ["vx", "vy"]
    assert "(2 coordinates for 3 rows)" in beeline("jacobian", "gantry", "--q", "1,2").out


@pytest.mark.parametrize("options, says", [
    (("--wrench", "1,2,3"), ["--wrench", "FX,FY,FZ,MX,MY,MZ", "3 numbers"]),
    (("--wrench", "1,2,x,0,0,0"), ["--wrench", '"x"']),
    (("--derivative", "1,2"), ["--derivative", "6"]),
    (("--second-derivative", "0,0,0,0,0,0"), ["--derivative"]),
    (("--analytical", "euler"), ["--analytical", "rotation-vector"]),
])
def test_options_of_derivatives_are_refused_by_name(refused, options, says):
    refused(2, "jacobian", *UR5E, *options, says=says)
