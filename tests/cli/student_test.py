"""What a reader of the chapter asks: matrices link by link, gains side by side."""

import math

import numpy as np
import pytest

MOVE = ("move", "rrr", "--from", "0,0,0", "--to", "99.2,-68.8,-30.4", "--degrees")


@pytest.mark.parametrize("arm, q", [("rrr", "0.3,-0.2,1"), ("panda", "0,-0.7,0.1,-2.3,0,1.5,0.7"),
                                    ("rp", "0.4,0.3"), ("scara", "0.1,0.2,0.3,0.1")])
def test_links_multiply_to_the_tool(beeline, arm, q):
    answer = beeline("fk", arm, "--q", q, "--all", "--json").json
    product = np.array(answer["links"][0]["matrix"])
    for link in answer["links"][1:]:
        product = product @ np.array(link["in_previous"]["matrix"])
        assert np.allclose(product, link["matrix"], atol=1e-12)
    product = product @ np.array(answer["tool_in_link"]["matrix"])
    assert np.allclose(product, answer["pose"]["matrix"], atol=1e-12)


def test_the_matrices_of_the_worked_example(beeline):
    q = np.radians([112, -52, -60])
    answer = beeline("fk", "rrr", "--q", "112,-52,-60", "--degrees", "--all")
    for i, (angle, length) in enumerate(zip(q, (3.5, 3.5, 2))):
        begin = answer.out.index(f"T_{i + 1}^{i}, in ")
        rows = [[float(n) for n in line.split()[:3]] for line in answer.out[begin:].splitlines()[1:4]]
        c, s = math.cos(angle), math.sin(angle)
        assert np.allclose(rows, [[c, -s, length * c], [s, c, length * s], [0, 0, 1]], atol=1e-5)


def test_gains_side_by_side(beeline, tmp_path):
    gains = "0.05,0.1,0.5,1,1.5"
    answer = beeline(*MOVE, "--gain", gains, "--draw", "g.svg", "--json")
    assert answer.code == 0 and (tmp_path / "g.svg").exists()
    runs = answer.json["gains"]
    assert [run["gain"] for run in runs] == [0.05, 0.1, 0.5, 1, 1.5]
    for run in runs:
        alone = beeline(*MOVE, "--kp", run["gain"], "--json").json
        assert all(run[key] == alone[key] for key in ("status", "samples", "steps", "overshoot", "error"))
        # e_(t+1) = (1 - K_p) e_t until it is below the tolerance
        factor = abs(1 - run["gain"])
        steps = 1 if factor == 0 else math.ceil(math.log(1e-6 / math.radians(99.2)) / math.log(factor))
        assert abs(run["steps"] - steps) <= 1
    assert [run["overshoot"] for run in runs] == pytest.approx([0, 0, 0, 0, 0.5], abs=1e-9)
    table = beeline(*MOVE, "--gain", gains).out.splitlines()
    assert table[0].split() == ["gain", "samples", "time", "overshoot", "final", "error"] and len(table) == 7


def test_a_gain_that_diverges_is_a_no(beeline):
    answer = beeline(*MOVE, "--gain", "0.5,2.5", "--draw", "g.svg")
    assert answer.code == 1 and "gain 2.5" in answer.err and "not_converged" in answer.out


@pytest.mark.parametrize("options, says", [
    (("--gain", "0.1,0"), ["--gain", "above 0"]),
    (("--gain", "0.1,,1"), ["--gain"]),
    (("--kp", "0.1,nan"), ["--kp"]),
    (("--gain", ",".join(["0.1"] * 33)), ["--gain", "32"]),
    (("--gain", "0.1,1", "--out", "m.csv"), ["--out"]),
    (("--gain", "0.1,1", "--plot", "m.svg"), ["--plot"]),
    (("--gain", "0.1,1", "--draw", "m.bmp"), ["m.bmp"]),
    (("--gain", "0.1,1", "--method", "quickest"), ["--gain", "quickest"]),
])
def test_refused_gains(refused, tmp_path, options, says):
    refused(2, *MOVE, *options, says=says)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("joints, name", [("RRRRRR", "puma560"), ("RRRP", "scara")])
def test_a_hint_at_the_chapters_arms(beeline, joints, name):
    answer = beeline("show", joints)
    assert answer.code == 0 and name in answer.err
    assert beeline("show", joints + ":" + ",".join("1" * len(joints))).err == ""
    assert beeline("show", "RRR").err == ""
