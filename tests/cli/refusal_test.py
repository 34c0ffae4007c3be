"""Bad input: one clear line, the documented exit code, nothing on stdout, nothing written."""

import pytest

Q3 = ("--q", "0,0,0")

USAGE = [
    (("fk", "rrr", "--q", "1,2"), ["--q", "3", "2", "joint1"]),
    (("fk", "rrr", "--q", "1,nan,3"), ["--q", "nan", "finite"]),
    (("fk", "rrr", "--q", "1,inf,3"), ["--q", "inf", "finite"]),
    (("fk", "rrr", "--q", "1,x,3"), ["--q", "x"]),
    (("fk", "rrr", "--q", ""), ["--q"]),
    (("fk", "pnda", *Q3), ["pnda", "panda"]),
    (("fk", "RRR:1,2", *Q3), ["RRR", "3 letters", "2"]),
    (("fk", "RXR", *Q3), ["RXR"]),
    (("fk", "rrr"), ["--q"]),
    (("fk", "rrr", *Q3, "--nonsense"), ["--nonsense"]),
    (("fly",), ["fly", "fk, jacobian"]),
    (("mvoe",), ["mvoe", '"move"']),
    (("fkin", "rrr"), ["fkin", 'did you mean "fk"']),
    (("ikine", "rrr"), ['did you mean "ik"']),
    (("forward", "rrr"), ['did you mean "fk"']),
    (("jtraj", "rrr"), ['did you mean "move"']),
    (("show", "RPRX"), ["joint string RPRX", '"X"', "R, P, H, S, C, E, U"]),
    (("show", "RXRA"), ["unknown arm"]),
    (("jacobian", "rrr", *Q3, "--frame", "world"), ['--frame: unknown frame "world"', "base", "space", "world's axes"]),
    (("jacobian", "rrr", *Q3, "--frame", "tol"), ["tol", "tool"]),
    (("jacobian", "rrr", *Q3, "--task", "000000"), ["000000"]),
    (("ik", "rrr", "--pose", "1,2"), ["--pose", "x,y,theta"]),
    (("ik", "panda", "--pose", "1,2,3"), ["--pose", "--task position"]),
    (("ik", "panda", "--pose", "1,2,3,1,1,1,1"), ["quaternion"]),
    (("ik", "rrr", "--pose", "1,2,0", "--seed", "0,0"), ["--seed"]),
    (("ik", "rrr", "--pose", "1,2,0", "--tolerance", "-1"), ["tolerance"]),
    (("ik", "rrr", "--pose", "1,2,0", "--tolerance", "nan"), ["tolerance"]),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--gain", "0"), ["gain"]),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--gain", "nan"), ["gain"]),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--out", "a.txt"), ["a.txt", "csv"]),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--draw", "a.bmp"), ["bmp", "svg"]),
    (("move", "panda", "--from", "0,0,0,0,0,0,0", "--to", "0,0,0,-1,0,1,0"), ["joint4"]),
    (("figure", "1.10", "--out", "a.svg"), ["1.10", "1.6"]),
    (("figure", "1.6", "--out", "a.tiff"), ["tiff", "pdf"]),
    (("fk", "rrr", *Q3, "--tip", "tool0"), ["tip"]),
    (("fk", "RR:1e308,1e308", "--q", "0,0"), ["1e+06 m"]),
    (("fk", "PP:0,0", "--q", "1e308,1e308"), ["--q", "range of numbers"]),
    (("jacobian", "RPP", "--q", "1,1e308,1e308"), ["--q", "range of numbers"]),
    (("ik", "rrr", "--pose", "1,1,5,0,0,1"), ["--pose", "plane", "--task"]),
    (("show", "rrr", "--out", "a.txt"), ["a.txt", "json"]),
    (("show", "rrr", "--out", ""), ["--out", "empty"]),
    (("draw", "rrr", "--azimuth", "nan", "--out", "a.svg"), ["--azimuth"]),
    (("jacobian", "rrr", *Q3, "--task", "111110:tool", "--frame", "base"), [":tool", "--frame"]),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--out", "a.csv", "--draw", "a.csv"),
     ["a.csv"]),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--draw", "a.svg", "--plot", "./a.svg"),
     ["--draw and --plot", "a.svg"]),
    (("fk", "rrr", *Q3, "--json=false"), ["--json takes no value"]),
    (("fk", "rrr", *Q3, "--degrees=no"), ["--degrees takes no value"]),
    (("ik", "rrr", "--pose", "4,3,0", "--all=0"), ["--all takes no value"]),
    (("fk", "rrr", "--q="), ["--q needs a value that is not empty"]),
    (("fk", "rrr", "--q=", "0,0,0"), ["--q needs a value that is not empty"]),
    (("completion", "tcsh"), ["SHELL", '"tcsh"', "known: bash, zsh, fish"]),
    (("completion", "BASH"), ['did you mean "bash"?']),
    (("help", "batch", "fly"), ["KIND", '"fly"', "fk, jacobian, ik"]),
    (("help", "fk", "ik"), ["fk has no kinds"]),
    (("--foo",), ['unknown option "--foo"', "needs a verb"]),
    (("batch", "--json"), ['unknown option "--json"', "needs a verb: fk"]),
    (("--version", "x"), ['unexpected argument "x"']),
    (("ik", "rrr", "--pose", "4,3,0", "--grid=-1"), ["--grid", "from 2 to 10000, not -1"]),
    (("batch", "fk", "rrr", "--in", "-", "--out", "-", "--threads", "-1"),
     ["--threads", "from 0 to 1024, not -1"]),
    (("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--max-steps", "2000000000"),
     ["--max-steps", "from 1 to 10000000"]),
    (("ik", "rrr", "--pose", "x,3,0"), ['--pose: item 1: "x"']),
    (("ik", "rrr", "--pose", "4,3,0", "--task", "x"), ["--task: unknown task"]),
]


def test_the_command_alone_prints_a_short_help(beeline):
    answer = beeline()
    assert answer.code == 2 and answer.out == ""
    lines = answer.err.splitlines()
    assert lines[0].startswith("Beeline plans and proves motions of serial-link robot arms")
    assert len(lines) == 8 and lines[2] == lines[6] == "" and max(map(len, lines)) < 100
    examples = [line.split() for line in lines if line.startswith("  beeline ")]
    assert len(examples) == 3
    for example in examples:
        found = beeline(*example[1:])
        assert found.code == 0 and found.err == "" and found.out, example
    assert beeline("help").code == 0 and "`beeline help`" in lines[-1]


@pytest.mark.parametrize("arguments, says", USAGE, ids=lambda value: " ".join(value)[:60])
def test_bad_usage(refused, tmp_path, arguments, says):
    refused(2, *arguments, says=says)
    assert list(tmp_path.iterdir()) == []


URDF_HEAD = '<robot name="r"><link name="a"/><link name="b"/><link name="c"/>'
HINGE = ('<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{2}"/>'
         '<axis xyz="{3}"/><limit lower="{4}" upper="{5}" velocity="1"/></joint>')


def urdf(*joints):
    return URDF_HEAD + "".join(HINGE.format(*joint) for joint in joints) + "</robot>\n"


FILES = [
    ("unknown key", "a.json", '{"name": "a", "joint_string": "RR", "colour": "red"}', (),
     ["a.json", "colour"]),
    ("no convention", "a.json", '{"name": "a", "dh": {"rows": [{"a": 1}]}}', (),
     ["a.json", "standard", "modified"]),
    ("cut-off json", "a.json", '{"name": "a", "joint_str', (), ["a.json:1"]),
    ("cut off", "a.urdf", urdf(("j", "a", "b", "0 0 1", -1, 1))[:-40], (), ["a.urdf:1"]),
    ("cycle", "a.urdf",
     urdf(("i", "a", "b", "0 0 1", -1, 1), ("j", "b", "c", "0 0 1", -1, 1),
          ("k", "c", "a", "0 0 1", -1, 1)), ("--tip", "c"), ["a.urdf"]),
    ("no such tip", "a.urdf", urdf(("i", "a", "b", "0 0 1", -1, 1), ("j", "b", "c", "0 0 1", -1, 1)),
     ("--tip", "d"), ["a.urdf", '"d"', "c"]),
    ("two tips", "a.urdf", urdf(("i", "a", "b", "0 0 1", -1, 1), ("j", "a", "c", "0 0 1", -1, 1)),
     (), ["a.urdf", "tip", "b", "c"]),
    ("no axis length", "a.urdf",
     urdf(("i", "a", "b", "0 0 0", -1, 1), ("j", "b", "c", "0 0 1", -1, 1)), (),
     ["a.urdf:1", "axis"]),
    ("limits reversed", "a.urdf",
     urdf(("i", "a", "b", "0 0 1", 1, -1), ("j", "b", "c", "0 0 1", -1, 1)), (),
     ["a.urdf:1", "lower limit 1"]),
    ("not a number", "a.urdf",
     urdf(("i", "a", "b", "0 0 up", -1, 1), ("j", "b", "c", "0 0 1", -1, 1)), (), ["a.urdf:1", "up"]),
    ("negative velocity", "a.urdf",
     urdf(("i", "a", "b", "0 0 1", -1, 1), ("j", "b", "c", "0 0 1", -1, 1)).replace(
         'velocity="1"', 'velocity="-2"'), (), ["a.urdf:1", "joint i", "velocity limit -2"]),
    ("cut off in a tag", "a.urdf", '<robot name="r"', (), ["a.urdf:1", "cut off"]),
    ("huge pitch", "a.json", '{"name": "a", "joints": [{"name": "j", "type": "helical", '
     '"pitch": 1e300}]}', (), ["a.json:1", "1e+06 m/rad"]),
    ("pitch of zero", "a.json", '{"name": "a", "joints": [{"name": "j", "type": "helical", '
     '"pitch": -1e-20}]}', (), ["a.json:1", "such a joint is revolute"]),
    ("not a robot", "a.urdf", "<html></html>", (), ["a.urdf:1", "robot"]),
    ("empty", "a.urdf", "", (), ["a.urdf"]),
    ("binary", "a.json", "\x00\x01\x02", (), ["a.json"]),
]


@pytest.mark.parametrize("_, name, text, options, says", FILES, ids=[case[0] for case in FILES])
def test_a_bad_arm_file(refused, written, _, name, text, options, says):
    refused(3, "show", written(name, text), *options, says=says)


CSVS = [
    ("empty", "", ["w.csv"]),
    ("header only", "x,y,theta\n", ["w.csv"]),
    ("column missing", "x,theta\n1,2\n", ["w.csv", "y"]),
    ("unknown column", "x,y,theta,colour\n1,2,3,4\n", ["w.csv", "colour"]),
    ("ragged", "x,y,theta\n1,2,3\n4,5\n", ["w.csv:3"]),
    ("no number", "x,y,theta\n1,two,3\n", ["w.csv:2", "two", "y"]),
    ("not finite", "x,y,theta\n1,nan,3\n", ["w.csv:2", "nan"]),
    ("bad quaternion", "x,y,z,qw,qx,qy,qz\n1,0,0,1,1,0,0\n", ["w.csv:2", "quaternion"]),
]


@pytest.mark.parametrize("_, text, says", CSVS, ids=[case[0] for case in CSVS])
def test_a_bad_pose_file(refused, written, _, text, says):
    through = written("w.csv", text)
    refused(3, "line", "rrr", "--from", "0,1,0", "--through", through, says=says)


def test_files_that_are_not_there(refused, tmp_path):
    refused(3, "fk", "missing.urdf", *Q3, says=["missing.urdf"])
    refused(3, "line", "rrr", "--from", "0,1,0", "--through", "missing.csv", says=["missing.csv"])
    refused(3, "replay", "rrr", "missing.csv", says=["missing.csv"])
    refused(3, "show", str(tmp_path) + ".json", says=[".json"])


def test_a_value_out_of_range_in_a_file_names_the_file(refused, written):
    poses = written("poses.csv", "x,y,theta\n1e308,1e308,0\n")
    refused(3, "line", "rrr", "--from", "0,1,0", "--through", poses, says=["poses.csv:2", "1e100"])
    huge = written("huge.csv", "t,joint1,joint2,joint3\n0,1e200,0,0\n1,0,0,0\n")
    good = written("good.csv", "t,joint1,joint2,joint3\n0,0.1,0,0\n1,0,0,0\n")
    says = ["huge.csv", "sample 1", "joint1"]
    refused(3, "check", "rrr", good, "--through", poses, says=["poses.csv:2"])
    refused(3, "retime", "rrr", huge, says=says)
    refused(3, "diff", "rrr", good, huge, says=says)
    refused(3, "replay", "rrr", huge, says=says)


def test_a_file_of_unknown_kind(refused, written):
    refused(3, "show", written("a.txt", "x"), says=["a.txt", ".urdf"])
    for verb in ("retime", "replay"):
        refused(3, verb, "rrr", written("a.bin", "x"), says=["a.bin", ".csv, .json, .yaml"])


@pytest.mark.parametrize("options", [("--out", "no/such/folder/a.csv"), ("--draw", "no/such/a.svg")])
def test_an_output_that_cannot_be_written(beeline, options):
    answer = beeline("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", *options)
    assert answer.code == 3 and options[1] in answer.err and answer.out == ""


def test_nothing_is_left_when_one_of_two_outputs_cannot_be_written(beeline, tmp_path):
    answer = beeline("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--out", "a.csv",
                     "--draw", "no/such/a.svg")
    assert answer.code == 3 and list(tmp_path.iterdir()) == []


def test_an_input_is_never_overwritten(refused, beeline, written, tmp_path):
    through = written("w.csv", "x,y,theta\n4,3,0\n")
    refused(2, "line", "rrr", "--from", "0,1.5,0", "--through", through, "--out", through,
            says=["w.csv", "input"])
    assert (tmp_path / "w.csv").read_text().startswith("x,y,theta")


@pytest.mark.parametrize("method, option", [
    ("exact", "--gain"), ("exact", "--intermediate"), ("inverse-jacobian", "--tool-speed"),
    ("inverse-kinematics", "--tolerance"),
])
def test_an_option_without_effect_is_refused(refused, written, method, option):
    through = written("w.csv", "x,y,theta\n4,3,0\n")
    refused(2, "line", "rrr", "--from", "0,1.5,0", "--through", through, "--method", method,
            option, "1", says=[option, method])


def test_a_planar_pose_is_refused_for_a_spatial_arm(refused, written):
    through = written("w.csv", "x,y,theta\n1,2,3\n")
    refused(3, "line", "ur5", "--from", "0,0,0,0,0,0", "--through", through,
            says=["w.csv:2", "ur5"])
