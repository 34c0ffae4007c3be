"""Every file that line writes passes check at its own tolerance, and faults put into it are found."""

import csv
import math
import os
import random

import pytest

from random_cases import cases as number_of_cases

SEED = int(os.environ.get("BEELINE_SEED", "20240229"))
STARTS = {"rrr": [1.0, -0.9, 0.4], "puma560": [0.2, -0.6, 0.3, 0.4, 0.7, 0],
          "ur5": [0.2, -1.2, 1.5, -0.5, 1.2, 0], "irb120": [0.3, 0.2, -0.1, 0.4, 0.8, 0],
          "hc10": [0.2, 0.3, 0.2, 0.3, -1.1, 0.2], "scara": [0.3, 0.5, 0.1, 0.1],
          "panda": [0, 0.3, 0, -1.6, 0, 1.2, 0.785]}


def listed(q):
    return ",".join(map(repr, q))


@pytest.fixture
def random_line(beeline, tmp_path):
    """random_line(case) plans a random line; returns the arguments of its check, or None."""

    def plan(case):
        arm = case.choice(list(STARTS))
        start = [x + case.uniform(-0.09, 0.09) for x in STARTS[arm]]
        path = case.choice([[], [], ["--blend", repr(10 ** case.uniform(-3.9, -1.5))], ["--path", "spline"],
                            ["--path", "screw"]])
        rows = []
        for _ in range(case.randint(2, 6)):
            q = [x + case.uniform(-0.1, 0.1) for x in start]
            pose = beeline("fk", arm, "--q=" + listed(q), "--json").json["pose"]
            planar = "planar" in pose
            rows.append([pose["planar"][key] for key in ("x", "y", "theta")] if planar else
                        pose["translation"] + [pose["quaternion"][key] for key in ("qw", "qx", "qy", "qz")])
        header = "x,y,theta" if planar else "x,y,z,qw,qx,qy,qz"
        (tmp_path / "w.csv").write_text("\n".join([header, *map(listed, rows)]) + "\n")
        through = ["--through", "w.csv", "--tolerance", repr(10 ** case.uniform(-8, -4)),
                   "--orientation-tolerance", repr(10 ** case.uniform(-8, -2)), *path]
        options = case.choice([[], ["--from=" + listed(start)], ["--from=" + listed(start)]])
        options += case.choice([[], ["--profile", case.choice(["fastest", "trapezoidal", "quintic"])]])
        options += case.choice([[], [], ["--rate", "250"], ["--interpolation", "cubic"]])
        file = case.choice(["m.csv", "m.csv", "m.json"])
        made = beeline("line", arm, *through, *options, "--out", file, "--json")
        assert made.code in (0, 1), made.err
        if made.code == 1:
            return None
        return ["check", arm, file, *through], made.json, bool(options and "--from" in options[0])

    return plan


def test_line_and_check_agree(beeline, random_line):
    checked = 0
    for i in range(number_of_cases(60)):
        made = random_line(random.Random(f"{SEED} {i}"))
        if made is None:
            continue
        check, line, from_start = made
        answer = beeline(*check, "--json")
        assert answer.code == 0, f"BEELINE_SEED={SEED}, case {i}: {check}: {answer.err}"
        if from_start:  # the same path: without a start, the first pose itself is on it
            assert answer.json["deviation_bound"] == line["deviation_bound"], check
        checked += 1
    assert checked > number_of_cases(60) / 3


def pause(rows, k):
    """Half a second between samples k and k + 1 at the same positions, in the middle of the motion."""
    return rows[:k + 1] + [[row[0] + 0.5, *row[1:]] for row in rows[k:]]


def faster(rows, k):
    """The same positions in half of the time."""
    n = (len(rows[0]) - 1) // 3
    return [[0.5 * row[0], *row[1:n + 1], *(v / 0.5 for v in row[n + 1:2 * n + 1]),
             *(a / 0.25 for a in row[2 * n + 1:])] for row in rows]


def backwards(rows, k):
    """The velocities of one sample with the other sign."""
    n = (len(rows[0]) - 1) // 3
    row = rows[k]
    return rows[:k] + [[*row[:n + 1], *(-v for v in row[n + 1:2 * n + 1]), *row[2 * n + 1:]]] + rows[k + 1:]


def aside(rows, k):
    """One sample a tenth of a millirad beside the path."""
    return rows[:k] + [[rows[k][0], rows[k][1] + 1e-4, *rows[k][2:]]] + rows[k + 1:]


FAULTS = {"pause": pause, "cut start": lambda rows, k: rows[k:], "cut end": lambda rows, k: rows[:k],
          "faster": faster, "backwards": backwards, "aside": aside}


def test_faults_put_into_the_files_are_found(beeline, tmp_path):
    """The lines of `line` at a tolerance of a micrometre, each with one fault."""
    for arm, start in STARTS.items():
        q = [x + 0.1 * math.cos(i) for i, x in enumerate(start)]
        pose = beeline("fk", arm, "--q=" + listed(q), "--json").json["pose"]
        row = ([pose["planar"][key] for key in ("x", "y", "theta")] if "planar" in pose else
               pose["translation"] + [pose["quaternion"][key] for key in ("qw", "qx", "qy", "qz")])
        header = "x,y,theta" if "planar" in pose else "x,y,z,qw,qx,qy,qz"
        (tmp_path / "w.csv").write_text(header + "\n" + listed(row) + "\n")
        through = ("--through", "w.csv", "--tolerance", "1e-6", "--orientation-tolerance", "1e-6")
        made = beeline("line", arm, "--from=" + listed(start), *through, "--out", "m.csv")
        assert made.code == 0, made.err
        with open(tmp_path / "m.csv") as file:
            names, *rows = csv.reader(file)
        rows = [list(map(float, row)) for row in rows]
        for name, fault in FAULTS.items():
            faulty = fault(rows, len(rows) // 2)
            (tmp_path / "f.csv").write_text("\n".join([",".join(names), *map(listed, faulty)]) + "\n")
            answer = beeline("check", arm, "f.csv", *through)
            assert answer.code == 1, f"{arm}: {name} is not found"
