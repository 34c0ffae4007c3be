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


def test_a_plan_reports_each_of_its_lines():
    arm = beeline.arms.panda()
    start = np.array([0, -0.785, 0, -2.356, 0, 1.571, 0.785])
    here = beeline.forward_kinematics(arm, start)
    there = here.copy()
    there[:3, 3] += [0.05, 0.1, -0.05]
    fractions = []
    assert beeline.move_in_lines(arm, start, [there, here, there], progress=fractions.append)
    assert {1 / 3, 2 / 3, 1.0} <= set(fractions) and fractions == sorted(fractions)

    def fail(fraction):
        raise ArithmeticError("enough")

    with pytest.raises(ArithmeticError, match="enough"):
        beeline.move_in_lines(arm, start, [there, here], progress=fail)
