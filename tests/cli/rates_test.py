"""jacobian --rates-of: the joint rates of a velocity of the tool."""

import math

import numpy as np
import pytest

from arms import Q, joints, text

TWIST = "0.1,-0.05,0.2,0.3,0.1,-0.2"


@pytest.mark.parametrize("arm", ["panda", "ur5", "puma560", "iiwa14", "stanford"])
@pytest.mark.parametrize("frame", ["base", "tool", "space"])
def test_the_rates_give_the_velocity(beeline, arm, frame):
    ask = ("jacobian", arm, "--q", Q[arm], "--frame", frame, "--json")
    answer = beeline(*ask, "--rates-of", TWIST)
    assert answer.code == 0 and answer.json["status"] == "solved"
    matrix, rates = np.array(answer.json["jacobian"]), np.array(answer.json["rates"])
    twist = np.array(joints(TWIST))
    assert matrix @ rates == pytest.approx(twist, abs=1e-12)
    assert answer.json["tool_velocity"] == pytest.approx(list(twist), abs=1e-12)
    assert answer.json["residual"] < 1e-12 and answer.json["lost_directions"] == []
    assert rates == pytest.approx(np.linalg.pinv(matrix) @ twist, abs=1e-10)
    degrees = beeline(*ask[:3], text(np.degrees(joints(Q[arm])) if arm != "stanford" else
                                     [math.degrees(v) if k != 2 else v for k, v in enumerate(joints(Q[arm]))]),
                      *ask[4:], "--degrees", "--rates-of", text([*twist[:3], *np.degrees(twist[3:])]))
    shown = [r if (arm, k) == ("stanford", 2) else math.degrees(r) for k, r in enumerate(rates)]
    assert degrees.json["rates"] == pytest.approx(shown, abs=1e-9)
    assert degrees.json["units"]["rates"].startswith("deg/s")


def test_the_rows_belong_to_the_task(beeline, refused):
    planar = beeline("jacobian", "rrr", "--q", "0.1,0.8,-0.4", "--rates-of", "0.2,0.1,0.3", "--json")
    matrix = np.array(planar.json["jacobian"])
    assert matrix @ planar.json["rates"] == pytest.approx([0.2, 0.1, 0.3], abs=1e-12)
    free = beeline("jacobian", "rrr", "--q", "0.1,0.8,-0.4", "--rates-of", "0.2,0.1", "--task", "110", "--json").json
    least = np.linalg.pinv(np.array(free["jacobian"])) @ [0.2, 0.1]
    assert free["rates"] == pytest.approx(list(least), abs=1e-12)
    panda = beeline("jacobian", "panda", "--q", Q["panda"], "--rates-of=0,0,0.1", "--task", "position:tool",
                    "--frame", "tool", "--json")
    assert panda.code == 0 and len(panda.json["tool_velocity"]) == 3
    refused(2, "jacobian", "rrr", "--q", "0.1,0.8,-0.4", "--rates-of", TWIST,
            says=["--rates-of has 6 numbers; the rows of the task are x, y, theta"])
    refused(2, "jacobian", "panda", "--q", Q["panda"], "--rates-of", "1,2,x,0,0,0", says=["--rates-of: item 3"])
    refused(2, "jacobian", "panda", "--q", Q["panda"], "--damping", "0.1", says=["--damping needs --rates-of"])
    refused(2, "jacobian", "panda", "--q", Q["panda"], "--rates-of", TWIST, "--damping", "0", says=["--damping", "above 0"])


def test_a_singularity_is_a_no_that_names_the_lost_direction(beeline):
    stretched = ("jacobian", "rrr", "--q", "0,0,0", "--rates-of")
    answer = beeline(*stretched, "0.1,0,0", "--json")
    assert answer.code == 1
    assert answer.json["status"] == "singular" and answer.json["singular"] is True
    assert np.abs(answer.json["lost_directions"]) == pytest.approx(np.array([[1, 0, 0]]), abs=1e-12)
    assert answer.json["residual"] == pytest.approx(0.1)
    assert "singular" in answer.json["reason"] and "along x 1 (base frame)" in answer.json["reason"]
    assert answer.json["reason"] in answer.err
    text_answer = beeline(*stretched, "0.1,0,0")
    assert "lost direction" in text_answer.out and text_answer.code == 1
    wrist = beeline("jacobian", "ur5", "--q", "0.3,-1,1,0.4,0,0.2", "--rates-of", TWIST, "--json")
    assert wrist.code == 1 and len(wrist.json["lost_directions"]) == 1
    lost = np.array(wrist.json["lost_directions"][0])
    assert np.array(wrist.json["jacobian"]).T @ lost == pytest.approx(np.zeros(6), abs=1e-9)
    # A velocity across the lost direction is possible: its rates are given.
    across = beeline(*stretched, "0,0.1,0", "--json")
    assert across.code == 0 and across.json["singular"] is True
    assert np.array(across.json["jacobian"]) @ across.json["rates"] == pytest.approx([0, 0.1, 0], abs=1e-12)


def test_damping_gives_rates_everywhere_and_says_what_results(beeline):
    answer = beeline("jacobian", "rrr", "--q", "0,0.001,0", "--rates-of", "0.1,0,0", "--damping", "0.1", "--json").json
    matrix, twist = np.array(answer["jacobian"]), np.array([0.1, 0, 0])
    expected = matrix.T @ np.linalg.solve(matrix @ matrix.T + 0.01 * np.eye(3), twist)
    assert answer["status"] == "damped"
    assert answer["rates"] == pytest.approx(list(expected), abs=1e-12)
    assert answer["tool_velocity"] == pytest.approx(list(matrix @ expected), abs=1e-12)
    assert answer["residual"] == pytest.approx(np.linalg.norm(matrix @ expected - twist))
    assert beeline("jacobian", "rrr", "--q", "0,0,0", "--rates-of", "0.1,0,0", "--damping", "0.1").code == 0


def test_rates_above_a_limit_are_named(beeline):
    ask = ("jacobian", "panda", "--q", Q["panda"], "--json", "--rates-of")
    answer = beeline(*ask, "2,0,0,0,0,0")
    assert answer.code == 0
    rates = dict(zip(answer.json["columns"], answer.json["rates"]))
    assert answer.json["excesses"]
    for excess in answer.json["excesses"]:
        assert abs(rates[excess["joint"]]) > excess["limit"] and rates[excess["joint"]] == excess["rate"]
        assert f"{excess['joint']} exceeds its velocity limit" in answer.err
    scale = answer.json["scale"]
    assert scale == pytest.approx(min(e["limit"] / abs(e["rate"]) for e in answer.json["excesses"]))
    slower = beeline(*ask, f"{2 * scale * 0.999999},0,0,0,0,0")
    assert slower.json["excesses"] == [] and slower.err == "" and slower.json["scale"] == 1


def test_joints_without_a_known_limit_are_named(beeline, written):
    answer = beeline("jacobian", "puma560", "--q", Q["puma560"], "--rates-of", TWIST, "--json").json
    known = [j["limits"]["velocity"] is not None for j in beeline("show", "puma560", "--json").json["joints"]]
    assert answer["without_limit"] == [name for name, there in zip(answer["columns"], known) if not there] != []
    text_answer = beeline("jacobian", "puma560", "--q", Q["puma560"], "--rates-of", TWIST).out
    assert f"not compared     {', '.join(answer['without_limit'])}   (their velocity limits are not known)" in text_answer
    written("l.json", '{"joint3": {"velocity": 1}}')
    some = beeline("jacobian", "puma560", "--q", Q["puma560"], "--rates-of", TWIST, "--limits", "l.json", "--json").json
    assert some["without_limit"] == [name for name in answer["without_limit"] if name != "joint3"]
    panda = ("jacobian", "panda", "--q", Q["panda"], "--rates-of", TWIST)
    assert beeline(*panda, "--json").json["without_limit"] == []
    assert "not compared" not in beeline(*panda).out


@pytest.mark.parametrize("task", ["position:tool", "spatial:tool", "111110:tool"])
def test_the_frame_belongs_to_the_task(beeline, refused, written, task):
    ask = ("jacobian", "panda", "--q", Q["panda"], "--task", task)
    answer = beeline(*ask, "--json").json
    assert answer["frame"] == "tool" and answer == beeline(*ask, "--frame", "tool", "--json").json
    assert "Jacobian in the tool frame" in beeline(*ask).out
    for frame in ("base", "space"):
        refused(2, *ask, "--frame", frame, says=[f"--task {task}", f"--frame {frame}", "leave out :tool or --frame"])
    written("q.csv", "0.1,0.2,0.3,-1,0.5,1,0.7\n")
    batch = ("batch", "jacobian", "panda", "--in", "q.csv", "--task", task, "--out", "j.csv", "--json")
    assert beeline(*batch).json["frame"] == "tool"
    assert beeline("formula", "panda", "--of", "jacobian", "--task", task).out == beeline(
        "formula", "panda", "--of", "jacobian", "--task", task, "--frame", "tool").out
