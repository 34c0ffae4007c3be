"""progress=True: a bar of tqdm or a line of text on stderr, which ends."""

import sys

import beeline
import numpy as np
import pytest
from beeline._progress import ProgressBar


@pytest.fixture
def without_tqdm(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)


def test_a_line_of_text(without_tqdm, capsys):
    bar = ProgressBar("retiming", delay=0)
    for fraction in [0, 0.1, 0.101, 0.05, 0.5, 1, 1]:
        bar(fraction)
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err == "\rretiming:   0 %\rretiming:  10 %\rretiming:  50 %\rretiming: 100 %\n"


def test_work_that_ends_early_ends_its_line(without_tqdm, capsys):
    bar = ProgressBar(delay=0)
    bar(0.4)
    del bar
    assert capsys.readouterr().err == "\rbeeline:  40 %\n"


def test_short_work_shows_nothing(capsys):
    bar = ProgressBar(delay=100)
    bar(0.5)
    bar(1)
    del bar
    assert capsys.readouterr().err == ""


def test_a_bar_of_tqdm(capsys):
    pytest.importorskip("tqdm")
    bar = ProgressBar("planning", delay=0)
    for fraction in [0, 0.3, 1]:
        bar(fraction)
    shown = capsys.readouterr().err
    assert "planning: 100%" in shown and shown.endswith("\n")


def test_no_stderr(monkeypatch):
    bar = ProgressBar(delay=0)
    monkeypatch.setattr(sys, "stderr", None)
    bar(0.5)
    bar(1)


def reported(work):
    fractions = []
    result = work(progress=fractions.append)
    assert fractions == sorted(fractions) and fractions[-1] == 1 and 0 <= fractions[0]
    return result, fractions


def test_retiming_reports_its_sections(seed):
    arm = beeline.arms.panda()
    q = arm.middle + np.random.default_rng(seed).uniform(-0.3, 0.3, (9, 7))
    q[3] = q[4]  # a stop
    path = beeline.Trajectory(arm.joint_names, range(9), q)
    timed, fractions = reported(lambda **keywords: beeline.retime(arm, path, **keywords))
    assert timed == beeline.retime(arm, path) and len(fractions) == 2 * timed.sections == 4


def test_batches_report_the_poses_computed(seed):
    arm = beeline.arms.panda()
    q = arm.middle + np.random.default_rng(seed).uniform(-0.3, 0.3, (3000, 7))
    poses = beeline.forward_kinematics(arm, q)
    done, fractions = reported(lambda **keywords: beeline.batch_inverse(arm, poses, **keywords))
    assert done.computed == 3000 and 10 < len(fractions) <= 101
    np.testing.assert_array_equal(done.q, beeline.batch_inverse(arm, poses).q)

    def fail(fraction):
        raise ArithmeticError("enough")

    with pytest.raises(ArithmeticError, match="enough"):
        beeline.batch_inverse(arm, poses, progress=fail)


def test_the_search_for_one_pose_has_no_progress():
    arm = beeline.arms.panda()
    with pytest.raises(TypeError, match="progress"):
        beeline.inverse_kinematics(arm, beeline.forward_kinematics(arm, arm.middle), progress=True)


def test_what_reports_no_progress_refuses_the_keyword():
    arm = beeline.arms.panda()
    start, goal = arm.middle, arm.middle + 0.1
    pose = beeline.forward_kinematics(arm, start)
    moved = beeline.point_to_point(arm, start, goal)
    motion = beeline.sampled(arm, moved, 100)
    for work in [
        lambda **options: beeline.sampled(arm, moved, 100, **options),
        lambda **options: beeline.limit_usage(arm, motion, **options),
        lambda **options: beeline.verify(arm, motion, [pose], **options),
        lambda **options: beeline.first_joint_fault(arm, motion, **options),
        lambda **options: beeline.replay(arm, motion, **options),
        lambda **options: beeline.control_joints(arm, start, goal, **options),
        lambda **options: beeline.control_in_lines(arm, start, [pose], **options),
    ]:
        work(time_limit=60)
        with pytest.raises(TypeError, match='unknown option "progress"'):
            work(progress=True)


def test_a_plan_reports_its_search_its_lines_and_its_timing():
    arm = beeline.arms.panda()
    start = np.array([0, -0.785, 0, -2.356, 0, 1.571, 0.785])
    here = beeline.forward_kinematics(arm, start)
    there = here.copy()
    there[:3, 3] += [0.05, 0.1, -0.05]
    fractions = []
    assert beeline.move_in_lines(arm, start, [there, here, there], progress=fractions.append)
    assert fractions == sorted(fractions) and fractions[-1] == 1
    assert max(np.diff([0, *fractions])) <= 0.25

    def fail(fraction):
        raise ArithmeticError("enough")

    with pytest.raises(ArithmeticError, match="enough"):
        beeline.move_in_lines(arm, start, [there, here], progress=fail)
