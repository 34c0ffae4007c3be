"""--plot: a motion's joints and tool over time, and its deviation along its lines."""

import os

import pytest

THROUGH = "x,y,theta\n4.5,5.2,0\n2,6,45\n5,3,-20\n"
LINE = ("line", "rrr", "--from", "0,90,0", "--degrees", "--through", "waypoints.csv")
SIGNATURES = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF-", "SVG": b"<?xml"}


@pytest.fixture
def line(beeline, written):
    written("waypoints.csv", THROUGH)
    return lambda *options: beeline(*LINE, *options)


@pytest.mark.parametrize("ending", SIGNATURES)
def test_every_format(line, tmp_path, ending):
    name = f"plot.{ending}"
    answer = line("--plot", name)
    assert answer.code == 0, answer.err
    assert f"plot          {name}\n" in answer.out
    content = (tmp_path / name).read_bytes()
    assert content.startswith(SIGNATURES[ending]) and len(content) > 10_000


@pytest.mark.parametrize("method", ["exact", "inverse-jacobian", "inverse-kinematics"])
def test_line_by_every_method(line, tmp_path, method):
    report = line("--method", method, "--plot", "p.svg", "--json").json
    assert report["plot"] == "p.svg"
    assert (tmp_path / "p.svg").stat().st_size > 10_000


def test_every_verb_that_makes_a_motion(line, beeline, tmp_path):
    line("--out", "line.csv")
    commands = [
        ("retime", "rrr", "line.csv"),
        ("replay", "rrr", "line.csv"),
        ("check", "rrr", "line.csv", "--through", "waypoints.csv", "--degrees"),
        ("move", "rrr", "--from", "0,0,0", "--to", "1,1,1"),
        ("move", "panda", "--from", "0,-1,0,-2,0,2,0", "--to", "1,0,0,-2,0,2,0",
         "--method", "quickest"),
    ]
    for number, command in enumerate(commands):
        name = f"{number}.svg"
        answer = beeline(*command, "--plot", name, "--json")
        assert answer.code == 0, answer.err
        assert answer.json["plot"] == name
        assert (tmp_path / name).stat().st_size > 10_000


def test_the_same_bytes_twice(line, tmp_path):
    line("--plot", "a.svg")
    line("--plot", "b.svg")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_a_failed_check_is_plotted(line, beeline, written, tmp_path):
    line("--out", "line.csv")
    written("other.csv", "x,y,theta\n4.5,5.2,0\n2,5,45\n5,3,-20\n")
    answer = beeline("check", "rrr", "line.csv", "--through", "other.csv", "--degrees",
                     "--plot", "p.svg", "--json")
    assert answer.code == 1 and answer.json["plot"] == "p.svg"
    assert (tmp_path / "p.svg").exists()


def test_all_or_nothing(line, refused, written, tmp_path):
    before = sorted(os.listdir(tmp_path))
    for options, says in [
        (("--out", "m.csv", "--plot", "p.gif"), ["p.gif", ".svg, .png or .pdf"]),
        (("--out", "m.csv", "--draw", "a.svg", "--plot", "a.svg"), ["--draw and --plot"]),
        (("--draw", "a.svg", "--plot", "missing/p.svg"), ["missing"]),
        (("--draw", "missing/a.svg", "--plot", "p.svg"), ["missing"]),
    ]:
        answer = line(*options)
        assert answer.code in (2, 3)
        assert answer.out == "" and all(part in answer.err for part in says), answer.err
        assert sorted(os.listdir(tmp_path)) == before
    written("arm.svg", "RRR")
    refused(3, "line", "arm.svg", "--from", "0,1,0", "--through", "waypoints.csv", "--plot", "p.svg")
    refused(2, "check", "rrr", "m.csv", "--through", "waypoints.csv", "--plot", "p.txt", says=["p.txt"])


def test_nothing_is_plotted_without_a_motion(beeline, written, tmp_path):
    written("far.csv", "x,y,theta\n40,5.2,0\n")
    answer = beeline("line", "rrr", "--from", "0,90,0", "--degrees", "--through", "far.csv",
                     "--plot", "p.svg", "--json")
    assert answer.code == 1 and "plot" not in answer.json
    assert not (tmp_path / "p.svg").exists()
