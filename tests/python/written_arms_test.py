"""Arms to files and to DH tables: Arm.save(), to_urdf(), to_mjcf(), dh_table()."""

import warnings

import numpy as np
import pytest

import beeline

PANDA = beeline.arms.panda()


def same_arm(a, b):
    q = PANDA.random(50, seed=1)
    np.testing.assert_allclose(beeline.forward_kinematics(a, q), beeline.forward_kinematics(b, q), rtol=0, atol=1e-12)
    assert a.joint_names == b.joint_names
    np.testing.assert_array_equal([a.lower, a.upper], [b.lower, b.upper])


def test_files_read_back(tmp_path):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for name in ("a.json", "a.urdf"):
            PANDA.save(tmp_path / name)
            same_arm(beeline.Arm.load(tmp_path / name), PANDA)
            np.testing.assert_array_equal(beeline.Arm.load(tmp_path / name).jerk, PANDA.jerk)
    with pytest.warns(beeline.InputWarning, match="no limits of velocity, acceleration and jerk, as MJCF has none: joint1"):
        PANDA.save(tmp_path / "a.xml")
    same_arm(beeline.Arm.load(tmp_path / "a.xml"), PANDA)
    assert (tmp_path / "a.json").read_text() == PANDA.to_json()
    assert (tmp_path / "a.urdf").read_text() == PANDA.to_urdf()


def test_texts_read_back():
    same_arm(beeline.Arm.from_urdf(PANDA.to_urdf()), PANDA)
    with pytest.warns(beeline.InputWarning):
        same_arm(beeline.Arm.from_urdf(PANDA.to_mjcf()), PANDA)


def test_what_a_format_cannot_say_is_an_error_and_nothing_is_written(tmp_path):
    arm = beeline.Arm.from_string("RHR:1,0.2p0.05,1")
    for name in ("a.urdf", "a.xml"):
        with pytest.raises(beeline.Error, match="^the arm is not written: joint2 is helical; "):
            arm.save(tmp_path / name)
    with pytest.raises(beeline.Error, match="joint2 is helical"):
        arm.to_urdf()
    with pytest.raises(beeline.Error, match="[.]urdf"):
        arm.save(tmp_path / "a.txt")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_a_table_makes_the_arm(convention):
    table = PANDA.dh_table(convention)
    assert table and table.convention == convention and table.misfits == []
    assert table.freedom[0] == "end" and len(table.freedom) == 8
    arm = beeline.Arm.from_dh(table.rows, convention=convention, limits=PANDA.limits)
    arm = arm.with_tool(table.tool).with_mount(table.base)
    q = PANDA.random(50, seed=2)
    np.testing.assert_allclose(beeline.forward_kinematics(arm, q), beeline.forward_kinematics(PANDA, q), rtol=0, atol=1e-12)


def test_an_arm_without_a_table_says_why():
    table = beeline.Arm.from_string("RHR:1,0.2p0.05,1").dh_table("standard")
    assert not table and table.rows == []
    assert table.misfits[0].joint == "joint2" and table.misfits[0].helical
    with pytest.raises(beeline.Error, match="convention.*standard"):
        PANDA.dh_table("craig")
