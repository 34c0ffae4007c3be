"""ik: both elbows, statuses, reasons."""

import math

import pytest


def test_both_elbows_of_the_chapters_arm(beeline):
    goal = beeline("fk", "rrr", "--q", "99.2,-68.8,-30.4", "--degrees", "--json").json
    planar = goal["pose"]["planar"]
    pose = ",".join(repr(planar[key]) for key in ("x", "y", "theta"))
    answer = beeline("ik", "rrr", "--pose", pose, "--all", "--degrees", "--json").json
    assert answer["status"] == "solved" and len(answer["solutions"]) == 2
    near = min(
        max(abs(math.remainder(a - b, 360)) for a, b in zip(q, (99.2, -68.8, -30.4)))
        for q in answer["solutions"]
    )
    assert near < 1e-6 and answer["residual"] < 1e-9


@pytest.mark.parametrize("arm", ["panda", "ur5", "puma560", "iiwa14", "stanford", "scara"])
def test_what_ik_returns_reaches_the_pose(beeline, arm):
    middle = beeline("show", arm, "--json").json["joints"]
    q = [
        (j["limits"]["lower"] * 0.6 + j["limits"]["upper"] * 0.4) for j in middle
    ]
    text = ",".join(map(repr, q))
    pose = beeline("fk", arm, "--q", text, "--json").json["pose"]
    quaternion = [pose["quaternion"][key] for key in ("qw", "qx", "qy", "qz")]
    goal = ",".join(map(repr, pose["translation"] + quaternion))
    answer = beeline("ik", arm, "--pose", goal, "--json").json
    assert answer["status"] == "solved"
    solution = ",".join(map(repr, answer["solutions"][0]))
    there = beeline("fk", arm, "--q", solution, "--json")
    assert there.err == ""  # within limits
    for a, b in zip(sum(there.json["pose"]["matrix"], []), sum(pose["matrix"], [])):
        assert a == pytest.approx(b, abs=1e-8)


def test_no_is_an_answer_with_a_reason(beeline):
    answer = beeline("ik", "rrr", "--pose", "8,8,0", "--json")
    assert answer.code == 1
    assert answer.json["status"] == "unreachable" and answer.json["solutions"] == []
    assert answer.json["reason"] and answer.json["reason"] in answer.err


def test_limits_block_unless_ignored(beeline, written):
    arm = written(
        "stiff.json",
        '{"name": "stiff", "joints": [{"name": "a", "type": "revolute",'
        ' "limits": {"lower": -0.5, "upper": 0.5}}], "tool": {"xyz": [1, 0, 0]}}',
    )
    pose = f"{math.cos(1)!r},{math.sin(1)!r},1"
    answer = beeline("ik", arm, "--pose", pose, "--json")
    assert answer.code == 1 and answer.json["status"] == "outside_limits"
    assert " a " in answer.json["reason"]
    free = beeline("ik", arm, "--pose", pose, "--ignore-limits", "--json")
    assert free.code == 0 and free.json["solutions"][0] == pytest.approx([1])


def test_the_same_seed_gives_the_same_answer(beeline):
    arguments = ("ik", "panda", "--pose", "0.3,0.2,0.5,3,0.1,0.2", "--json", "--random-seed", "7")
    assert beeline(*arguments).out == beeline(*arguments).out
