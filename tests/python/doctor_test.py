"""diagnose() and compare_arms(): findings and differences as data."""

import math
import pickle

import numpy as np
import pytest

import beeline

UR5 = np.array([[0, math.pi / 2, 0.089159, 0], [-0.425, 0, 0, 0], [-0.39225, 0, 0, 0],
                [0, math.pi / 2, 0.10915, 0], [0, -math.pi / 2, 0.09465, 0], [0, 0, 0.0823, 0]])


@pytest.mark.parametrize("name", ["rrr", "ur5", "panda", "scara"])
def test_built_in_arms_are_clear(name):
    assert beeline.diagnose(name)
    diagnosis = beeline.diagnose(beeline.Arm.load(name))
    assert diagnosis and diagnosis.findings == []


def test_a_finding_has_its_joint():
    rows = UR5.copy()
    rows[3, 1] = 1.5708
    diagnosis = beeline.diagnose(beeline.Arm.from_dh(rows, convention="standard"))
    assert not diagnosis
    (finding,) = diagnosis.findings
    assert (finding.kind, finding.joint) == ("rounded_angle", 3)


def test_a_file_is_diagnosed(tmp_path):
    path = tmp_path / "r.urdf"
    path.write_text('<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="continuous">'
                    '<parent link="a"/><child link="b"/></joint></robot>')
    assert [finding.kind for finding in beeline.diagnose(path).findings] == ["missing_axis"]
    with pytest.raises(beeline.FileError):
        beeline.diagnose(tmp_path / "missing.urdf")


def test_faults_of_a_file_need_no_chain(tmp_path):
    joint = '<joint name="{0}" type="{1}"><parent link="{2}"/><child link="{3}"/></joint>\n'
    path = tmp_path / "r.urdf"
    path.write_text('<robot name="r">\n<link name="a"/><link name="b"/><link name="c"/>\n' + joint.format("ab", "ball", "a", "b")
                    + joint.format("bc", "revolute", "nowhere", "c") + "</robot>")
    with pytest.raises(beeline.Error):
        beeline.Arm.load(path)
    assert [fault.place for fault in beeline.file_faults(path)] == ["line 3", "line 4"]
    assert beeline.file_faults("panda") == []


def test_mount_and_tool_are_recovered(rng):
    a = beeline.arms.puma560()
    mount, tool = (beeline.forward_kinematics(a, rng.uniform(-1, 1, 6)) for _ in range(2))
    comparison = beeline.compare_arms(a, a.with_tcp(tool).with_mount(mount))
    assert comparison.status == "reconciled" and comparison.explained and not comparison
    poses = {difference.kind: difference.pose for difference in comparison.differences}
    assert np.allclose(poses["mount"], mount, atol=1e-7) and np.allclose(poses["tool"], tool, atol=1e-7)


def test_one_number_is_named():
    rows = UR5.copy()
    rows[0, 2] = 0.089459
    a, b = (beeline.Arm.from_dh(each, convention="standard") for each in (UR5, rows))
    comparison = beeline.compare_arms(a, b)
    (difference,) = comparison.differences
    assert (difference.kind, difference.joint, difference.parameter) == ("length", 0, "d")
    assert (difference.a, difference.b) == pytest.approx((0.089159, 0.089459))
    assert pickle.loads(pickle.dumps(comparison)) == comparison
    assert beeline.compare_arms(a, b, tolerance=1e-3)
    with pytest.raises(beeline.Error, match="tolerance"):
        beeline.compare_arms(a, b, tolerance=0)
