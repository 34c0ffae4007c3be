"""Objects of the module: what may be written, compared, pickled, and called by several at once."""

import pickle
import signal
import warnings

import beeline
import numpy as np
import pytest


@pytest.fixture
def arm():
    return beeline.arms.panda()


def test_objects_compare_with_others(arm):
    for value in (arm, beeline.Limits(), beeline.at_rest(arm, arm.middle)):
        assert not value == None and value != None  # noqa: E711
        assert value != 1 and value in [None, value]


def test_objects_are_immutable(arm):
    with pytest.raises(AttributeError, match="lowr"):
        beeline.Limits().lowr = 3
    with pytest.raises(AttributeError):
        beeline.Limits().lower = 3
    for array in (arm.base, arm.tool, arm.controller_base, arm.flange, arm.lower, arm.middle, arm.joints[0].offset):
        assert not array.flags.writeable


def test_the_controllers_frames_stay_on_the_arm(arm):
    root, mount, tcp = np.eye(4), np.eye(4), np.eye(4)
    root[2, 3], mount[0, 3], tcp[1, 3] = 0.4, 2, 0.1
    made = beeline.Arm("own", arm.joints, tool=tcp, controller_base=root, flange=np.eye(4))
    cell = made.with_tcp(tcp).with_mount(mount)
    for copy in (cell, pickle.loads(pickle.dumps(cell))):
        np.testing.assert_array_equal(copy.controller_base, mount @ root)
        np.testing.assert_array_equal(copy.flange, np.eye(4))
        np.testing.assert_array_equal(copy.tool, tcp @ tcp)
        assert copy == cell != made
    assert np.array_equal(beeline.Arm("own", arm.joints, tool=tcp).flange, tcp)
    assert not (made.controller_base_assumed or made.flange_assumed)
    for stated in ({}, {"controller_base": root}, {"flange": tcp}, {"controller_base": root, "flange": tcp}):
        placed = beeline.Arm("own", arm.joints, tool=tcp, **stated).with_tcp(tool_T_tcp=tcp).with_mount(mount)
        for copy in (placed, pickle.loads(pickle.dumps(placed)), beeline.Arm.from_json(placed.to_json())):
            assert copy.controller_base_assumed == ("controller_base" not in stated)
            assert copy.flange_assumed == ("flange" not in stated)
            np.testing.assert_array_equal(copy.flange, tcp)
    np.testing.assert_array_equal(beeline.arms.kr6_r900().controller_base, np.eye(4))
    assert not np.array_equal(beeline.arms.kr6_r900().base, np.eye(4))


def test_functions_pickle(arm):
    for function in (beeline.forward_kinematics, beeline.inverse_kinematics, beeline.Arm.load):
        assert pickle.loads(pickle.dumps(function)) is function


def test_paths_with_null_bytes_are_refused(arm, tmp_path):
    kept = tmp_path / "kept"
    kept.write_text("kept")
    with pytest.raises(beeline.Error, match="null"):
        beeline.at_rest(arm, arm.middle).save(f"{kept}\0.csv")
    assert kept.read_text() == "kept"


def test_arms_have_names_that_copies_can_have(arm):
    for name in ("", "a\nb", "x" * 2000):
        with pytest.raises(beeline.Error, match="name"):
            beeline.Arm(name, arm.joints)


def test_results_are_not_written_over_their_arguments(arm, rng):
    rows, wrenches = rng.uniform(arm.lower, arm.upper, (9, 7)), np.ones((8, 7))
    kept = rows.copy()
    for out in (rows[1:], rows[:-1], rows[8:0:-1]):
        with pytest.raises(beeline.Error, match="out has memory of q"):
            beeline.joint_torques(arm, rows[:-1], np.ones(6), out=out)
    with pytest.raises(beeline.Error, match="out has memory of wrench"):
        beeline.joint_torques(arm, rows[:-1], wrenches[:, :6], out=wrenches)
    with pytest.raises(beeline.Error, match="out has memory of base"):
        base = np.eye(4)
        beeline.forward_kinematics(arm, arm.middle, base=base, out=base)
    with pytest.raises(beeline.Error, match="out has memory of dq"):
        beeline.tool_acceleration(arm, rows[0], kept[0], rows[1], out=kept[0, 1:])
    assert np.array_equal(rows, kept)


def test_results_beside_their_arguments(arm, rng):
    table = np.hstack([rng.uniform(arm.lower, arm.upper, (9, 7)), np.zeros((9, 7))])
    expected = beeline.joint_torques(arm, table[:, :7], np.ones(6))
    beeline.joint_torques(arm, table[:, :7], np.ones(6), out=table[:, 7:])
    assert np.array_equal(table[:, 7:], expected)


def test_limits_that_no_arm_has_are_refused():
    for wrong in ({"lower": np.nan}, {"lower": 2, "upper": 1}, {"velocity": 0}, {"jerk": np.nan}, {"lower": np.inf}):
        with pytest.raises(beeline.Error, match="limit"):
            beeline.Limits(**wrong)


def test_a_table_of_dh_rows(arm, rng):
    table = rng.uniform(-1, 1, (5, 4))
    rows = [beeline.DhRow(a=a, alpha=alpha, d=d, theta=theta) for a, alpha, d, theta in table]
    for convention in ("standard", "modified"):
        expected = beeline.Arm.from_dh(rows, convention=convention)
        assert beeline.Arm.from_dh(table, convention=convention) == expected
        assert beeline.Arm.from_dh(table.tolist(), convention=convention) == expected
    for wrong in (table[:, :3], table[0], table * np.nan, []):
        with pytest.raises(beeline.Error):
            beeline.Arm.from_dh(wrong, convention="standard")
    for wrong in (None, "table", [rows[0], 1]):
        with pytest.raises(TypeError, match="rows"):
            beeline.Arm.from_dh(wrong, convention="standard")


def test_numbers_that_cannot_be_converted(arm):
    class Interrupted:
        def __float__(self):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        beeline.Deviation(Interrupted(), 0)
    with pytest.raises(beeline.Error, match="position"):
        beeline.Deviation(10**400, 0)
    with pytest.raises(beeline.Error, match="lock"):
        beeline.inverse_kinematics(arm, np.eye(4), lock=10**5000)


REACHABLE = np.array([[1, 0, 0, 0.3], [0, 1, 0, 0.3], [0, 0, 1, 0.3], [0, 0, 0, 1]])


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs timers")
def test_a_signal_handler_may_solve_for_the_arm_that_it_interrupts(arm):
    long = {"method": "numerical", "all": True, "max_restarts": 10**6, "time_limit": 0.5}
    expected = beeline.inverse_kinematics(arm, REACHABLE, method="numerical")
    answers = []
    former = signal.signal(signal.SIGALRM, lambda *_: answers.append(
        beeline.inverse_kinematics(arm, REACHABLE, method="numerical")))  # fmt: skip
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        assert beeline.inverse_kinematics(arm, REACHABLE, **long).status == "time_limit"
    finally:
        signal.signal(signal.SIGALRM, former)
    assert answers == [expected]


def test_commands_that_are_not_finite(arm):
    for row in range(6):
        command = np.zeros(6)
        command[row] = np.nan
        with pytest.raises(beeline.Error):
            beeline.Servo(arm).step(arm.middle, command)


GRIPPER = """<robot name="r"><link name="a"/><link name="b"/><link name="stator"/><link name="mover"/>
<joint name="j" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
<joint name="f" type="fixed"><parent link="b"/><child link="stator"/></joint>
<joint name="jointGripper" type="revolute"><parent link="stator"/><child link="mover"/></joint>
<joint name="camera" type="fixed"><parent link="nowhere"/><child link="lens"/></joint></robot>"""


def test_what_a_reader_selected_or_left_out_is_a_warning(tmp_path):
    path = tmp_path / "r.urdf"
    path.write_text(GRIPPER)
    for read in (lambda: beeline.Arm.load(path), lambda: beeline.Arm.from_urdf(path), lambda: beeline.Arm.from_urdf(GRIPPER)):
        with pytest.warns(beeline.ModelWarning) as issued:
            assert read().joint_names == ["j"]
        selected, fault = (warning.message for warning in issued)
        assert (selected.kind, selected.joint, selected.link, selected.others) == (
            "before_gripper", "jointGripper", "stator", ["mover"])
        assert str(selected).endswith('tip="mover" includes it')
        assert (fault.kind, fault.joint, fault.link, fault.line) == ("unknown_link", "camera", "nowhere", 5)
        assert (fault.element, fault.element_fault, fault.others) == ("<parent>", "none", ["a", "b", "stator", "mover"])
        assert issued[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error", beeline.ModelWarning)
        with pytest.raises(beeline.ModelWarning):
            beeline.Arm.load(path)
        assert beeline.Arm.from_urdf("\ufeff" + GRIPPER.split("<joint name=\"camera")[0] + "</robot>", tip="b").dof == 1


def test_a_reason_is_a_sentence_with_data(arm):
    pose = np.eye(4)
    pose[0, 3] = 3
    result = beeline.inverse_kinematics(arm, pose)
    reason = result.reason
    assert reason and isinstance(reason, str) and isinstance(reason, beeline.Reason)
    assert reason.code == "position_unreachable"
    assert reason.fields["distance"] == result.residual
    assert reason.fields["nearest"] == list(result.nearest.world_T_tool[:3, 3])
    solved = beeline.inverse_kinematics(arm, beeline.forward_kinematics(arm, [0, -0.8, 0, -2.4, 0, 1.6, 0.8]))
    assert not solved.reason and solved.reason.code == "none" and solved.reason.fields == {}
    for again in (pickle.loads(pickle.dumps(reason)), pickle.loads(pickle.dumps(result)).reason):
        assert (again, again.code, again.fields) == (reason, reason.code, reason.fields)


def test_reasons_are_equal_if_their_data_are() -> None:
    reason = beeline.Reason("no", "ended", {"s": 1.0})
    same = beeline.Reason("no", "ended", {"s": 1.0})
    assert reason == same and not reason != same and hash(reason) == hash(same)
    detail = beeline.Reason("no", "ended", {"s": 1.0}, [same])
    others = [beeline.Reason("no", "none", {"s": 1.0}), beeline.Reason("no", "ended"), detail]
    assert all(reason != other and not reason == other for other in others)
    assert reason == "no" and "no" == reason and reason != "yes" and hash(reason) == hash("no")
