"""The main job on URDF files that nobody here wrote: straight at the samples, within limits."""

import json
import subprocess

import pytest
from urdf_tree import ROBOTS

ARMS = {
    "panda_description/urdf/panda.urdf": ("panda_hand_tcp", [0, -0.8, 0, -2.4, 0, 1.6, 0.8]),
    "ur_description/urdf/ur5_robot.urdf": ("tool0", [0, -1.2, 1.5, -0.5, 1.2, 0]),
    "ur_description/urdf/ur10_robot.urdf": ("tool0", [0, -1.2, 1.5, -0.5, 1.2, 0]),
    "kinova_description/robots/kinova.urdf": ("j2s6s200_end_effector", [0, 3, 1.5, 0.5, 1.5, 0.5]),
    "xarm_description/urdf/xarm7.urdf": (None, [0, -0.5, 0, 0.9, 0, 1.2, 0]),
}


@pytest.mark.parametrize("path", ARMS, ids=lambda path: path.rsplit("/")[-1])
def test_a_real_arm_moves_in_straight_lines(path, build, tmp_path):
    tip, start = ARMS[path]
    arm = [str(ROBOTS / path), *(["--tip", tip] if tip else [])]

    def beeline(*arguments):
        command = [str(build / "beeline"), *arguments, "--json"]
        answer = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
        assert answer.returncode == 0, answer.stderr
        return json.loads(answer.stdout)

    rows = ["x,y,z,qw,qx,qy,qz"]
    for step in (0.15, -0.1, 0.2):
        q = [value + step * (-1) ** i for i, value in enumerate(start)]
        pose = beeline("fk", *arm, "--q", ",".join(map(repr, q)))["pose"]
        rows.append(",".join(map(repr, [*pose["translation"], *pose["quaternion"].values()])))
    (tmp_path / "poses.csv").write_text("\n".join(rows) + "\n")

    report = beeline("line", *arm, "--from", ",".join(map(repr, start)), "--through", "poses.csv",
                     "--out", "move.csv", "--draw", "move.svg")
    assert report["status"] == "reached"
    assert report["deviation_sampled"] < 1e-6 and report["orientation_sampled"] < 1e-6
    assert report["deviation_bound"] <= 1e-4 and report["orientation_bound"] <= 1e-3
    # checks the limits of position and velocity
    replayed = beeline("replay", arm[0], "move.csv", *arm[1:])
    assert replayed["status"] == "reached"
