"""ik: poses at singularities and limits to which it once had no answer, or a false reason."""

import csv
import json
from pathlib import Path

import pytest

ARMS = Path(__file__).parent.parent / "inverse" / "arms"
GEN3, PX150 = str(ARMS / "gen3.json"), str(ARMS / "px150.json")

REACHED = {
    "gripper rolled, written with seven decimals": (PX150, "0.25,0,0.1,1.5707963,0,0"),
    "gripper rolled, next to the singularity of the wrist": (
        PX150,
        "-0.2481960452210292,0.11360972319476165,0.040587917178923336,"
        "0.3970942994257449,-0.11754988130692332,0.6972675681060104,0.5850778420311568",
    ),
    "stanford, wrist straight to 1e-8": (
        "stanford",
        "-0.15210807863660014,-0.02406517268972336,1.3798236247397107,"
        "0.15412056810518499,7.597374469550668e-10,5.97279443566803e-11,-0.9880520484705929",
    ),
    "ur5, wrist straight to 5e-8": (
        "ur5",
        "0.8261673040651015,-0.2525353470181593,0.3997719071457545,"
        "0.09110682675051202,0.14213560989983387,0.6926741554658126,-0.7012128983893391",
    ),
    "ur5, wrist straight": (
        "ur5",
        "0.7949860719359032,0.026849920501393565,0.3999544121589578,"
        "0.21576706854944414,0.21576706854944638,-0.6733829528495258,0.6733829096961189",
    ),
}


@pytest.mark.parametrize("case", REACHED)
def test_a_solution_within_limits_is_found(ik, case):
    arm, pose = REACHED[case]
    answer = ik(arm, pose)
    assert answer["status"] == "solved", answer["reason"]
    assert answer["residual"] <= 1e-10


@pytest.mark.parametrize("case", REACHED)
def test_batch_gives_what_ik_gives(beeline, ik, tmp_path, case):
    arm, pose = REACHED[case]
    names = "x,y,z,qw,qx,qy,qz" if pose.count(",") == 6 else "x,y,z,roll,pitch,yaw"
    (tmp_path / "poses.csv").write_text(f"{names}\n{pose}\n")
    single = ik(arm, pose)
    for options in ((), ("--status",)):
        answer = beeline("batch", "ik", arm, "--in", "poses.csv", "--out", "q.csv", *options)
        assert answer.code == 0, answer.err
        (row,) = csv.DictReader((tmp_path / "q.csv").open())
        assert [float(row[name]) for name in list(row)[: len(single["solutions"][0])]] == single[
            "solutions"
        ][0]
    assert row["status"] == "0" and float(row["residual"]) == single["residual"]


def test_status_and_residual_of_poses_without_a_solution(beeline, ik, tmp_path):
    poses = {"unreachable": "3,0,0,1,0,0,0", "outside_limits": "0.1,0,0.1,0.5,0.5,0.5,-0.5"}
    text = "x,y,z,qw,qx,qy,qz\n" + "\n".join(poses.values()) + "\n"
    (tmp_path / "poses.csv").write_text(text)
    answer = beeline(
        "batch", "ik", "panda", "--in", "poses.csv", "--out", "q.csv", "--status", "--json"
    )
    assert answer.code == 1 and answer.json["columns"][-2:] == ["status", "residual"]
    codes = ["solved", "unreachable", "orientation_unreachable", "outside_limits", "not_found"]
    for row, pose in zip(csv.DictReader((tmp_path / "q.csv").open()), poses.values()):
        single = ik("panda", pose)
        assert codes[int(row["status"])] == single["status"]
        assert float(row["residual"]) == pytest.approx(single["residual"], rel=1e-9)


def test_a_stretched_arm_of_seven_joints_is_answered(beeline, ik, pose_at, seed):
    import random

    draw = random.Random(seed)
    for _ in range(20):
        q = [draw.uniform(-3, 3), draw.uniform(-1.5, 1.5), 0, 0, 0, draw.uniform(-1.9, 1.9)]
        q.append(draw.uniform(-3, 3))
        answer = ik(GEN3, pose_at(GEN3, ",".join(map(repr, q))))
        assert answer["status"] == "solved", (q, answer["reason"])


def test_a_locked_elbow_leaves_a_solution_within_limits(ik):
    pose = (
        "0.37662145438449873,0.39606590210423887,0.62588861260699,"
        "0.4653715318836768,-0.43983032585185744,-0.7300436784686984,-0.2387778241403096"
    )
    answer = ik("iiwa14", pose, "--lock", "joint4=-1.4270747280972897")
    assert answer["status"] == "solved", answer["reason"]
    assert answer["solutions"][0][3] == -1.4270747280972897


def test_infinitely_many_solutions_are_not_called_all(beeline):
    pose = (
        "0.08265620305430549,1.1990204103546667,-0.2748684669111059,0.48722733607783414,"
        "-0.8338173065065135,-0.015842928394490675,-0.2590506204752406"
    )
    arm = str(ARMS / "rank_deficient.json")
    answer = json.loads(beeline("ik", arm, "--pose=" + pose, "--all", "--json").out)
    assert answer["status"] == "solved" and answer["singular"] and not answer["complete"]
    assert "infinitely many" in answer["reason"]
