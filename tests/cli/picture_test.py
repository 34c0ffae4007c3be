"""Pictures as files: SVG that any parser reads, with texts that hold no markup."""

import os
import re
from xml.etree import ElementTree

import pytest

SVG = "{http://www.w3.org/2000/svg}"
NUMBER = re.compile(r"-?(?:\d+\.?\d*|\.\d+)(?:e-?\d+)?|nan|inf", re.IGNORECASE)


@pytest.fixture
def parsed(tmp_path):
    """parsed("a.svg") -> the root, of which no coordinate is NaN or far off the page."""

    def parse(name):
        root = ElementTree.parse(tmp_path / name).getroot()
        width, height = map(float, root.get("viewBox").split()[2:])
        for path in root.iter(SVG + "path"):
            for number in map(float, NUMBER.findall(path.get("d"))):
                assert -10 <= number <= max(width, height) + 10, path.get("d")
        return root

    return parse


@pytest.mark.parametrize("title", ["</text><script>alert(1)</script>", 'a"b&amp;<c>\'', "\x01\x1b[31m\x7f",
                                   "関節 Ünïcödé 🤖", "]]>", "&#0;"])
def test_titles_hold_no_markup(beeline, parsed, title):
    assert beeline("draw", "rrr", "--title", title, "--out", "a.svg").code == 0
    texts = ["".join(text.itertext()) for text in parsed("a.svg").iter(SVG + "text")]
    assert re.sub(r"[\x00-\x1f\x7f]", "?", title) in texts
    assert not list(parsed("a.svg").iter(SVG + "script"))


def test_names_of_joints_hold_no_markup(beeline, written, parsed):
    written("a.urdf", """<robot name="&lt;robot&gt;"><link name="a"/><link name="b"/>
      <joint name="&lt;/svg&gt;&amp;" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
      <origin xyz="0.3 0 0.5"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>""")
    answer = beeline("move", "a.urdf", "--from", "0", "--to", "0.5", "--plot", "p.svg", "--draw", "d.svg")
    assert answer.code == 0, answer.err
    parsed("d.svg")
    assert "</svg>&" in ["".join(text.itertext()) for text in parsed("p.svg").iter(SVG + "text")]


def test_a_motion_is_animated(beeline, parsed, tmp_path):
    beeline("move", "panda", "--from", "0,-0.8,0,-2.4,0,1.6,0.8", "--to", "0.5,0,0,-2,0,2,0",
            "--method", "quickest", "--out", "m.csv")
    answer = beeline("draw", "panda", "m.csv", "--animate", "a.svg", "--playback-speed", "0.5", "--json")
    assert answer.code == 0 and answer.json["animation"] == "a.svg", answer.err
    with open(tmp_path / "m.csv") as rows:
        duration = float(rows.read().split()[-1].split(",")[0])
    seconds = {animation.get("dur") for animation in parsed("a.svg").iter(SVG + "animate")}
    assert len(seconds) == 1
    assert float(seconds.pop().rstrip("s")) == pytest.approx(2 * duration + 2, abs=0.02)  # with its rests
    assert (tmp_path / "a.svg").stat().st_size < 500_000


@pytest.mark.parametrize("number", ["1.7", "1.9"])
def test_figures_are_animated(beeline, parsed, number):
    answer = beeline("figure", number, "--animate", "a.svg", "--out", "f.png")
    assert answer.code == 0 and "a.svg" in answer.out and "f.png" in answer.out
    assert any(animation.get("attributeName") == "d" for animation in parsed("a.svg").iter(SVG + "animate"))


def test_a_picture_without_cairo(beeline, written, tmp_path):
    """The loader finds a file of that name that is no library."""
    written("libcairo.so.2", "no library\n")
    refused = beeline("draw", "rrr", "--out", "arm.png", env=os.environ | {"LD_LIBRARY_PATH": str(tmp_path)})
    if refused.code == 0:
        pytest.skip("this build loads Cairo by another name, or links it")
    assert refused.code == 2 and refused.out == "" and not (tmp_path / "arm.png").exists()
    assert "libcairo.so.2" in refused.err and "install Cairo, or write an .svg" in refused.err
    assert len(refused.err.splitlines()) == 1


def test_an_animation_without_ffmpeg(beeline, tmp_path):
    answer = beeline("figure", "1.7", "--animate", "a.gif", env=os.environ | {"PATH": ""})
    assert answer.code == 2 and "apt install ffmpeg" in answer.err and answer.err.count("\n") == 1
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("arguments, says", [
    (("draw", "rrr"), ["--out", "--animate"]),
    (("draw", "rrr", "--animate", "a.svg"), ["--animate", "a motion"]),
    (("draw", "rrr", "m.csv", "--animate", "a.bmp"), ["a.bmp", ".svg, .gif, .mp4 or .webp"]),
    (("draw", "rrr", "m.csv", "--animate", "m.csv.svg", "--out", "./m.csv.svg"), ["--animate and --out"]),
    (("draw", "rrr", "m.csv", "--out", "a.svg", "--fps", "10"), ["--fps", "--animate"]),
    (("draw", "rrr", "m.csv", "--animate", "a.svg", "--playback-speed", "0"), ["--playback-speed"]),
    (("figure", "1.7"), ["--out", "--animate"]),
    (("figure", "1.6", "--animate", "a.svg"), ["1.7, 1.9"]),
])
def test_refusals(beeline, written, refused, tmp_path, arguments, says):
    written("m.csv", "t,joint1,joint2,joint3\n0,0,0,0\n1,1,1,1\n")
    refused(2, *arguments, says=says)
    assert [file.name for file in tmp_path.iterdir()] == ["m.csv"]


@pytest.mark.parametrize("rows", ["0,0,0,nan", "0,0,0,inf", "0,0,0,1e200"])
def test_a_motion_that_is_not_finite(written, refused, tmp_path, rows):
    written("m.csv", f"t,joint1,joint2,joint3\n-1,0,0,0\n{rows}\n")
    refused(3, "draw", "rrr", "m.csv", "--animate", "a.svg")
    assert not (tmp_path / "a.svg").exists()


def numbers(parsed, name):
    """The numbers of the waypoints in a picture, each once."""
    return {text.text for text in parsed(name).iter(SVG + "text") if text.get("fill") == "#d95e03"}


@pytest.mark.parametrize("options", [("--from", "0,90,0"), (), ("--from", "0,90,0", "--blend", "0.3"),
                                     ("--path", "spline"), ("--from", "0,90,0", "--method", "inverse-jacobian")])
def test_one_numbering_of_waypoints(beeline, written, parsed, options):
    written("w.csv", "x,y,theta\n6,2.5,30\n-0.5,6.5,120\n-4,2.5,180\n")
    answer = beeline("line", "rrr", "--degrees", "--through", "w.csv", *options, "--draw", "d.svg",
                     "--plot", "p.svg", "--out", "m.csv")
    assert answer.code == 0, answer.err
    assert numbers(parsed, "d.svg") == numbers(parsed, "p.svg") == {"1", "2", "3"}
    if "--blend" not in options and "--path" not in options:
        beeline("check", "rrr", "m.csv", "--through", "w.csv", "--degrees", "--plot", "c.svg",
                *(("--tolerance", "0.1", "--orientation-tolerance", "0.1") if "--method" in options else ()))
        assert numbers(parsed, "c.svg") == {"1", "2", "3"}


def test_the_goal_of_a_move_has_its_number(beeline, parsed):
    assert beeline("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--draw", "d.svg", "--plot", "p.svg").code == 0
    assert numbers(parsed, "d.svg") == numbers(parsed, "p.svg") == {"1"}


def test_one_numbering_of_a_programs_moves(beeline, written, parsed):
    written("pick.csv", "motion,x,y,theta,dwell\njoint,5,4,20,0.2\nline,4,4,20,\nline,4,3,20,\n")
    answer = beeline("line", "rrr", "--from", "10,60,20", "--degrees", "--through", "pick.csv", "--draw", "d.svg",
                     "--plot", "p.svg", "--out", "m.csv")
    assert answer.code == 0, answer.err
    answer = beeline("check", "rrr", "m.csv", "--through", "pick.csv", "--degrees", "--plot", "c.svg")
    assert answer.code == 0, answer.err
    assert numbers(parsed, "d.svg") == numbers(parsed, "p.svg") == numbers(parsed, "c.svg") == {"1", "2", "3"}


def test_all_figures(beeline, parsed, tmp_path, refused):
    answer = beeline("figure", "all", "--out", "figures", "--json")
    assert answer.code == 0, answer.err
    assert len(answer.json["files"]) == 10
    for file in answer.json["files"]:
        assert list(parsed(file).iter(SVG + "path"))
    refused(3, "figure", "all", "--out", "figures/figure_1.1.svg", says=["figure_1.1.svg", "folder"])
    refused(2, "figure", "all", "--out", "figures", "--animate", "a.svg", says=["--animate"])


def test_poses_in_the_picture_of_a_motion(beeline, written, parsed, refused):
    written("w.csv", "x,y,theta\n6,2.5,30\n-0.5,6.5,120\n")
    written("pick.csv", "motion,x,y,theta\njoint,5,4,20\n")
    written("m.csv", "t,joint1,joint2,joint3\n0,0,1,0\n1,1,1,1\n")
    draw = ("draw", "rrr", "m.csv", "--angle-unit", "rad", "--degrees")
    assert beeline(*draw, "--through", "w.csv", "--out", "d.svg", "--animate", "a.svg").code == 0
    assert numbers(parsed, "d.svg") == numbers(parsed, "a.svg") == {"1", "2"}
    assert beeline(*draw, "--through", "pick.csv", "--out", "e.svg").code == 0  # a program without parts
    assert numbers(parsed, "e.svg") == {"1"}
    refused(2, "draw", "rrr", "--through", "w.csv", "--out", "e.svg", says=["--through", "motion"])
    refused(2, *draw, "--through", "w.csv", "--animate", "w.csv.gif", "--out", "w.csv", says=["w.csv"])


@pytest.mark.parametrize("script, says", [("exit 0", "empty"), ("echo boom >&2; exit 3", "boom"), ("kill -9 $$", "ffmpeg"),
                                          ("exec cat > /dev/null", "empty")])
def test_an_ffmpeg_that_fails(beeline, tmp_path, script, says):
    (tmp_path / "bin").mkdir()
    program = tmp_path / "bin" / "ffmpeg"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    for ending in ("gif", "mp4", "webp"):
        answer = beeline("figure", "1.7", "--animate", f"a.{ending}", "--playback-speed", "50",
                         env=os.environ | {"PATH": f"{tmp_path}/bin:/usr/bin:/bin"})
        assert answer.code == 2 and "--animate" in answer.err and answer.err.count("\n") == 1
        assert says in answer.err or ending == "gif", answer.err
    assert [file.name for file in tmp_path.iterdir()] == ["bin"]


def test_a_motion_of_years_is_played_faster(beeline, written, refused):
    written("m.csv", "t,joint1,joint2,joint3\n0,1,1,1\n1e9,1,2,1\n")
    refused(2, "draw", "rrr", "m.csv", "--animate", "a.svg", says=["--animate", "day", "playback speed"])
