"""show --out in every format, show --as dh, and what is left out or refused: named, and nothing is written."""

import numpy as np
import pytest

Q = {"panda": "0.1,0.2,-0.3,-1.4,0.5,1.6,0.7", "ur5e": "0,-1.2,1.3,-1.5,-1.4,0.4", "scara": "0.4,-0.5,0.6,0.1"}


@pytest.mark.parametrize("arm", Q)
@pytest.mark.parametrize("file", ["arm.json", "arm.urdf", "arm.xml", "arm.mjcf"])
def test_an_arm_reads_back(beeline, matrix, arm, file):
    assert beeline("show", arm, "--out", file).code == 0
    assert matrix(file, Q[arm]) == pytest.approx(matrix(arm, Q[arm]), abs=1e-12)
    there, back = (beeline("show", name, "--json").json["joints"] for name in (arm, file))
    for a, b in zip(there, back, strict=True):
        assert a["name"] == b["name"] and a["type"] == b["type"]
        kept = ["lower", "upper"] if file.endswith(("xml", "mjcf")) else ["lower", "upper", "velocity", "acceleration", "jerk"]
        assert [a["limits"][key] for key in kept] == [b["limits"][key] for key in kept]


def test_tool_mount_and_limits_are_written(beeline, matrix):
    options = ["--tcp", "0,0,0.1,0.2,0.3,0.4", "--mount", "1,2,3,0.1,0.2,0.3"]
    assert beeline("show", "ur5e", *options, "--velocity", "2", "--out", "a.urdf").code == 0
    at = beeline("fk", "ur5e", *options, "--q", Q["ur5e"], "--json").json["pose"]["matrix"]
    assert matrix("a.urdf", Q["ur5e"]) == pytest.approx(sum(at, []), abs=1e-12)
    assert {joint["limits"]["velocity"] for joint in beeline("show", "a.urdf", "--json").json["joints"]} == {2}


def test_what_the_file_lacks_is_said(beeline):
    assert beeline("show", "panda", "--out", "a.urdf").err.splitlines() == [
        "beeline: warning: a.urdf has no shapes of the links; a .json file has them"]
    lines = beeline("show", "panda", "--out", "a.xml").err.splitlines()
    assert len(lines) == 2 and "no limits of velocity, acceleration and jerk, as MJCF has none: joint1" in lines[1]
    assert beeline("show", "rrr", "--out", "a.xml").err == ""


def test_what_stays_in_the_input_is_said(beeline, written):
    joint = '<joint name="j" type="revolute"><parent link="a"/><child link="b"/><limit lower="-1" upper="1" effort="5" velocity="1"/></joint>'
    for part in ("", "<visual/>", '<collision><geometry><mesh filename="none.stl"/></geometry></collision>'):
        written("in.urdf", f'<robot name="n"><link name="a"/><link name="b">{part}</link>{joint}</robot>')
        for file in ("out.json", "out.urdf"):
            lines = beeline("show", "in.urdf", "--out", file).err.splitlines()
            assert [f"{file} has no shapes of the links; they are in in.urdf" in line for line in lines].count(True) == bool(part)
            assert [f"{file} has no efforts" in line for line in lines].count(True) == file.endswith("urdf")


def test_nothing_is_written_without_the_table(beeline, tmp_path):
    answer = beeline("show", "RHR:1,0.2p0.05,1", "--as", "dh", "--convention", "standard", "--out", "a.json")
    assert answer.code == 1 and "a.json is not written" in answer.err and not list(tmp_path.iterdir())


@pytest.mark.parametrize("file", ["a.urdf", "a.xml"])
def test_a_gap_is_named_and_nothing_is_written(beeline, file, tmp_path):
    (tmp_path / file).write_text("as it was")
    answer = beeline("show", "RHR:1,0.2p0.05,1", "--out", file, "--json")
    assert answer.code == 1
    assert answer.json["gaps"] == [{"kind": "helical_joint", "joint": "joint2", "link": ""}]
    assert answer.err.startswith(f"beeline: {file} is not written: joint2 is helical; ") and answer.err.count("\n") == 1
    assert (tmp_path / file).read_text() == "as it was" and [path.name for path in tmp_path.iterdir()] == [file]


def test_refusals(refused, written):
    refused(2, "show", "rrr", "--out", "a.xacro", says=["a.xacro", ".urdf"])
    refused(2, "show", "rrr", "--as", "dh", says=["--convention", "standard", "modified"])
    refused(2, "show", "rrr", "--convention", "standard", says=["--as"])
    refused(2, "show", "rrr", "--as", "screws", "--convention", "standard", says=["--as dh"])
    refused(2, "show", "rrr", "--as", "dh", "--convention", "craig", says=["craig", "standard"])
    refused(3, "show", "rrr", "--out", "none/a.urdf", says=["none/a.urdf"])
    written("a.urdf", "<robot/>")
    refused(2, "show", "a.urdf", "--out", "./a.urdf", says=["input"])


def elementary(axis, angle, length):
    pose, (i, j) = np.eye(4), ((axis + 1) % 3, (axis + 2) % 3)
    pose[i, i] = pose[j, j] = np.cos(angle)
    pose[j, i], pose[i, j], pose[axis, 3] = np.sin(angle), -np.sin(angle), length
    return pose


@pytest.mark.parametrize("arm", Q)
@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("degrees", [False, True])
def test_the_table_gives_the_pose(beeline, matrix, arm, convention, degrees):
    unit = ["--degrees"] if degrees else []
    table = beeline("show", arm, "--as", "dh", "--convention", convention, "--json", *unit).json["dh"]
    assert table["convention"] == convention
    pose, factor = np.array(table["base"]), np.pi / 180 if degrees else 1
    for row, q in zip(table["rows"], map(float, Q[arm].split(",")), strict=True):
        theta, d = row["theta"] * factor, row["d"]
        about_z = elementary(2, theta, d + q) if row["type"] == "prismatic" else elementary(2, theta + q, d)
        about_x = elementary(0, row["alpha"] * factor, row["a"])
        pose = pose @ about_z @ about_x if convention == "standard" else pose @ about_x @ about_z
    assert (pose @ np.array(table["tool"])).ravel() == pytest.approx(matrix(arm, Q[arm]), abs=1e-12)


def test_the_text_is_the_makers_table(beeline):
    text = beeline("show", "ur5", "--as", "dh", "--convention", "standard", "--degrees").out
    rows = [line.split() for line in text.split("theta", 1)[1].splitlines() if line.startswith("  ") and "+ q" in line]
    assert [row[1:] for row in rows] == [
        ["0", "+", "q", "0.089159", "0", "90"], ["0", "+", "q", "0", "-0.425", "0"],
        ["0", "+", "q", "0", "-0.39225", "0"], ["0", "+", "q", "0.10915", "0", "90"],
        ["0", "+", "q", "0.09465", "0", "-90"], ["0", "+", "q", "0.0823", "0", "0"]]  # fmt: skip
    assert "frame 2: its origin along the axis, as the two axes are parallel" in text


@pytest.mark.parametrize("arm, says", [
    ("RHR:1,0.2p0.05,1", "joint2 is helical, which no row describes"),
    ("nearly.urdf", "the axis of j2 is nearly parallel to the axis before it: their common normal is "),
])  # fmt: skip
def test_without_a_table_the_screws_are_printed(beeline, written, arm, says):
    joint = '<joint name="j{0}" type="continuous"><parent link="l{1}"/><child link="l{0}"/><origin xyz="0.4 0.1 0.05" rpy="{2}"/></joint>'
    written("nearly.urdf", '<robot name="n">' + "".join(f'<link name="l{k}"/>' for k in range(4)) +
            joint.format(1, 0, "0 0 0") + joint.format(2, 1, "0 1e-7 0") + joint.format(3, 2, "1.5 0 0") + "</robot>")  # fmt: skip
    answer = beeline("show", arm, "--as", "dh", "--convention", "modified")
    assert answer.code == 1 and "home pose M" in answer.out and "no table of modified DH parameters" in answer.out
    assert says in answer.err and says in answer.out
    document = beeline("show", arm, "--as", "dh", "--convention", "modified", "--json").json
    assert document["dh"]["misfits"][0]["helical"] == (arm[0] == "R") and len(document["screws"]["joints"]) == 3


def test_couplings_are_printed_below_the_table(beeline, written):
    written("m.json", '{"name": "m", "joints": [{"name": "a", "type": "revolute"}, {"name": "b", "type": "revolute", '
                      '"origin": {"xyz": [1, 0, 0]}, "mimic": {"joint": "a", "multiplier": -1, "offset": 0.5}}]}')  # fmt: skip
    text = beeline("show", "m.json", "--as", "dh", "--convention", "standard").out
    assert "q of b = -1 * q of a + 0.5" in text
