"""doctor is silent on the models of example-robot-data, except on true flaws: right angles with few digits, revolute
joints whose limits are both 0, and velocity limits of 0."""

import json
import subprocess

import pytest
from urdf_tree import ROBOTS, UrdfTree

FLAWS = {  # file: what is wrong in it, read from its text
    "TwoDofs.urdf": {"rounded_angle"},  # 1.57
    "borinot_flying_arm_2.urdf": {"rounded_angle"},  # 1.5708
    "hextilt_flying_arm_5.urdf": {"rounded_angle"},  # 1.5708
    "icub.urdf": {"rounded_angle"},  # 1.5708
    "icub_reduced.urdf": {"rounded_angle"},  # 1.5708
    "romeo_laas_small.urdf": {"rounded_angle"},  # 1.5708
    "so100.urdf": {"rounded_angle"},  # 1.57079
    "so101.urdf": {"rounded_angle"},  # 1.5708
    "tiago_pro.urdf": {"rounded_angle"},  # 1.5708
    "xarm7.urdf": {"rounded_angle"},  # 1.5708
    "alex_psyonic_hands.urdf": {"fault"},  # fingers mimic joints of another prefix
    "centauro.urdf": {"no_range"},  # wheels that are revolute, limits 0 and 0
    "double_pendulum.urdf": {"no_range"},
    "double_pendulum_simple.urdf": {"no_range"},
    "quadruped.urdf": {"no_range"},
    "romeo.urdf": {"unknown_velocity"},  # fingers with velocity 0
}
FILES = sorted(ROBOTS.rglob("*.urdf"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_only_true_flaws_are_found(build, path):
    tree = UrdfTree(path)
    found, read = set(), 0
    for tip in tree.leaves():
        command = [build / "beeline", "doctor", path, "--tip", tip, "--json"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode > 1:
            continue  # no moving joint, or a floating one
        read += 1
        findings = json.loads(done.stdout)["findings"]
        assert (done.returncode == 1) == bool(findings)
        found |= {finding["kind"] for finding in findings}
    assert found == (FLAWS.get(path.name, set()) if read else set())
