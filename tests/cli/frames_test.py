"""Frames of a cell: --tcp, --mount, --work, --base, --tip, --srdf and --group."""

import math
import re

import pytest

from arms import Q, text

HEAD = '<robot name="r">' + "".join(
    f'<link name="{name}"/>' for name in ("base", "upper", "flange", "tool0", "camera")
)
JOINTS = """
<joint name="j1" type="revolute"><parent link="base"/><child link="upper"/>
  <origin xyz="0 0 0.5"/><axis xyz="0 0 1"/><limit lower="-2" upper="3" velocity="1"/></joint>
<joint name="j2" type="revolute"><parent link="upper"/><child link="flange"/>
  <origin xyz="0.4 0 0"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" velocity="1"/></joint>
"""
FIXED = '<joint name="to_{0}" type="fixed"><parent link="flange"/><child link="{0}"/>{1}</joint>'
URDF = (
    HEAD + JOINTS + FIXED.format("camera", '<origin xyz="0 0.1 0"/>')
    + FIXED.format("tool0", '<origin xyz="0.3 0 0"/>') + "</robot>"
)
SRDF = """<robot name="r">
<group name="arm"><chain base_link="base" tip_link="flange"/></group>
<group name="back"><joint name="j1"/><joint name="j2"/><joint name="to_camera"/></group>
<group_state name="home" group="arm">
  <joint name="j1" value="0.25"/><joint name="j2" value="-0.5"/></group_state>
<group_state name="far" group="arm"><joint name="j1" value="9"/><joint name="j2" value="0"/></group_state>
</robot>"""


def matrix(answer):
    assert answer.code == 0, answer.err
    return answer.json["pose"]["matrix"]


def product(*factors):
    result, *others = factors
    for other in others:
        result = [[sum(a * b for a, b in zip(row, column)) for column in zip(*other)] for row in result]
    return result


def inverse(pose):
    rotation = [list(column) for column in zip(*(row[:3] for row in pose[:3]))]
    back = [-sum(a * row[3] for a, row in zip(line, pose)) for line in rotation]
    return [[*line, x] for line, x in zip(rotation, back)] + [[0, 0, 0, 1]]


def same(found, expected, error=1e-12):
    for row, wanted in zip(found, expected):
        assert row == pytest.approx(wanted, abs=error)
    return True


def frame(x=0, y=0, z=0, roll=0, pitch=0, yaw=0):
    def turn(axis, angle):
        i, j = (axis + 1) % 3, (axis + 2) % 3
        m = [[float(row == column) for column in range(4)] for row in range(4)]
        m[i][i] = m[j][j] = math.cos(angle)
        m[j][i] = math.sin(angle)
        m[i][j] = -math.sin(angle)
        return m

    pose = product(turn(2, yaw), turn(1, pitch), turn(0, roll))
    for row, value in zip(pose, (x, y, z)):
        row[3] = value
    return pose


TCP, MOUNT, WORK = (0.1, -0.05, 0.2, 0.3, -0.4, 0.5), (1, 2, 0.7, 0, 0.2, 1.5), (0.4, 0.1, 0.3, 3, 0, 1)


@pytest.mark.parametrize("arm", ["panda", "ur5"])
def test_fk_is_the_tool_on_the_flange_of_an_arm_in_the_world(beeline, arm):
    plain = matrix(beeline("fk", arm, "--q", Q[arm], "--json"))
    answer = beeline("fk", arm, "--q", Q[arm], "--json", "--tcp", text(TCP), "--mount", text(MOUNT))
    assert same(matrix(answer), product(frame(*MOUNT), plain, frame(*TCP)))


def test_ik_takes_poses_in_the_work_frame(beeline):
    options = ("--tcp", text(TCP), "--mount", text(MOUNT))
    tool = matrix(beeline("fk", "ur5", "--q", Q["ur5"], "--json", *options))
    goal = product(inverse(frame(*WORK)), tool)
    yaw = math.atan2(goal[1][0], goal[0][0])
    pitch = math.asin(-goal[2][0])
    roll = math.atan2(goal[2][1], goal[2][2])
    pose = text([goal[0][3], goal[1][3], goal[2][3], roll, pitch, yaw])
    answer = beeline("ik", "ur5", "--pose", pose, "--work", text(WORK), *options, "--seed", Q["ur5"],
                     "--json")
    expected = [float(value) for value in Q["ur5"].split(",")]
    assert answer.json["solutions"][0] == pytest.approx(expected, abs=1e-6)


def test_a_translation_is_enough_for_a_frame_in_space_and_theta_in_the_plane(beeline):
    q = ("--q", "0.3,0.4,0.5", "--json")
    plain = matrix(beeline("fk", "rrr", *q))
    for mount in ("1,2,90", "1,2,0,0,0,90"):
        answer = beeline("fk", "rrr", "--q", text(map(math.degrees, (0.3, 0.4, 0.5))), "--json",
                         "--degrees", "--mount", mount)
        assert same(matrix(answer), product(frame(1, 2, yaw=math.pi / 2), plain))
    panda = ("fk", "panda", "--q", Q["panda"], "--json")
    expected = product(matrix(beeline(*panda)), frame(z=0.1))
    assert same(matrix(beeline(*panda, "--tcp", "0,0,0.1")), expected)


def test_lines_are_planned_and_checked_in_the_work_frame(beeline, written):
    world = "x,y,theta\n4.5,5.2,0\n2,6,0.5\n"
    moved = "x,y,theta\n5.2,-3.5,-1.5707963267948966\n6,-1,-1.0707963267948966\n"
    frame_of_work = ("--work", "1,0,1.5707963267948966")
    plain = beeline("line", "rrr", "--from", "0,1.5707963,0", "--through", written("w.csv", world),
                    "--out", "a.csv", "--json")
    answer = beeline("line", "rrr", "--from", "0,1.5707963,0", "--through", written("m.csv", moved),
                     *frame_of_work, "--out", "b.csv", "--json")
    assert answer.json["status"] == "reached"
    assert answer.json["duration"] == pytest.approx(plain.json["duration"], rel=1e-6)
    assert beeline("check", "rrr", "b.csv", "--through", "w.csv").code == 0
    assert beeline("check", "rrr", "b.csv", "--through", "m.csv", *frame_of_work).code == 0
    assert beeline("check", "rrr", "b.csv", "--through", "m.csv").code == 1


def test_batch_ik_takes_the_work_frame(beeline, written):
    written("p.csv", "x,y,theta\n3,4,0.5\n")
    written("w.csv", "x,y,theta\n2,2,0.5\n")
    for name, options in (("p", ()), ("w", ("--work", "1,2,0"))):
        assert beeline("batch", "ik", "rrr", "--in", f"{name}.csv", "--out", f"{name}.npy", *options
                       ).code == 0
        assert beeline("batch", "ik", "rrr", "--in", f"{name}.csv", "--out", "-", *options).code == 0
    assert beeline("batch", "ik", "rrr", "--in", "p.csv", "--out", "-").out == beeline(
        "batch", "ik", "rrr", "--in", "w.csv", "--out", "-", "--work", "1,2,0").out


def test_bad_frames_name_their_option(refused):
    fk = ("fk", "panda", "--q", Q["panda"])
    refused(2, *fk, "--tcp", "1,2", says=["--tcp: x,y is for planar arms", "x,y,z"])
    refused(2, *fk, "--tcp", "1,2,3,4", says=["--tcp: pose", "4 numbers"])
    refused(2, *fk, "--mount", "1,2,x", says=["--mount: item 3"])
    refused(2, *fk, "--mount", "0,0,0,2,0,0,0", says=["--mount: ", "length 2"])
    refused(2, *fk, "--tcp", "1e200,0,0", says=["--tcp: "])


@pytest.mark.parametrize("verb", ["fk", "jacobian", "ik", "batch fk", "batch jacobian", "batch ik",
                                  "show", "move", "line", "check", "retime", "replay", "draw", "diff"])
def test_every_verb_with_an_arm_has_the_options(beeline, verb):
    help_text = beeline(*verb.split(), "--help").out
    for option in ("--tcp", "--mount", "--rail", "--mobile-base", "--base", "--tip", "--srdf", "--group"):
        assert option in help_text


def test_chains_between_any_links(beeline, written):
    written("r.urdf", URDF)
    down = beeline("fk", "r.urdf", "--q", "0.4,-0.3", "--json")
    assert down.err == (
        "beeline: warning: the tip is tool0; other tips, fixed to the same link: camera; "
        "--tip selects another\n"
    )
    up = beeline("fk", "r.urdf", "--q", "-0.3,0.4", "--base", "tool0", "--tip", "base", "--json")
    assert up.err == ""
    assert same(product(matrix(up), matrix(down)), frame())
    joints = beeline("show", "r.urdf", "--base", "camera", "--tip", "base", "--json").json["joints"]
    assert [joint["name"] for joint in joints] == ["j2", "j1"]
    assert [joint["link"] for joint in joints] == ["upper", "base"]
    assert [joint["limits"]["upper"] for joint in joints] == [1, 3]


def test_groups_and_named_states(beeline, written):
    written("r.urdf", URDF)
    srdf = ("--srdf", written("r.srdf", SRDF))
    home = beeline("fk", "r.urdf", *srdf, "--group", "arm", "--q", "home", "--json")
    assert home.err == ""
    typed = beeline("fk", "r.urdf", "--tip", "flange", "--q", "0.25,-0.5", "--json")
    assert matrix(home) == matrix(typed)
    degrees = beeline("fk", "r.urdf", *srdf, "--group", "arm", "--q", "home", "--json", "--degrees")
    assert matrix(degrees) == matrix(typed)
    tool = beeline("fk", "r.urdf", *srdf, "--group", "arm", "--tip", "tool0", "--q", "home", "--json")
    assert same(matrix(tool), product(matrix(typed), frame(x=0.3)))
    camera = beeline("fk", "r.urdf", *srdf, "--group", "back", "--q", "home", "--json")
    assert same(matrix(camera), product(matrix(typed), frame(y=0.1)))
    moved = beeline("move", "r.urdf", *srdf, "--group", "arm", "--from", "home", "--to", "0.1,0.2",
                    "--json")
    assert moved.code == 0


def test_states_serve_any_arm_with_these_joints(beeline, written):
    joints = [f"joint{k}" for k in range(1, 7)]
    values = "".join(f'<joint name="{joint}" value="0.1"/>' for joint in joints)
    written("u.srdf", f'<robot name="u"><group_state name="up" group="all">{values}</group_state></robot>')
    answer = beeline("fk", "ur5", "--srdf", "u.srdf", "--q", "up", "--json")
    assert matrix(answer) == matrix(beeline("fk", "ur5", "--q", text([0.1] * 6), "--json"))


def test_show_lists_groups_and_named_states(beeline, written):
    written("r.urdf", URDF)
    srdf = ("--srdf", written("r.srdf", SRDF), "--group", "arm")
    answer = beeline("show", "r.urdf", *srdf, "--json").json
    assert answer["groups"] == [{"name": "arm", "chain": "base to flange"},
                                {"name": "back", "chain": "base to camera"}]
    assert answer["states"] == [{"name": "home", "group": "arm", "joints": {"j1": [0.25], "j2": [-0.5]}},
                                {"name": "far", "group": "arm", "joints": {"j1": [9], "j2": [0]}}]
    text = beeline("show", "r.urdf", *srdf).out
    assert "base to flange" in text and "0.25, -0.5" in text
    assert "groups" not in beeline("show", "r.urdf", "--tip", "tool0").out


def test_reasons_of_line_are_in_the_work_frame(beeline, written):
    written("far.csv", "x,y,z,roll,pitch,yaw\n0.2,0.1,0.1,180,0,0\n1.2,0.1,0.1,180,0,0\n")
    written("p.csv", "motion,x,y,z,roll,pitch,yaw\njoint,0.2,0.1,0.1,180,0,0\n,1.2,0.1,0.1,180,0,0\n")
    work = ("--degrees", "--work", "0.3,0,0.2,0,0,30")
    for file in ("far.csv", "p.csv"):
        plain = beeline("line", "panda", "--through", file, *work)
        assert plain.code == 1
        at = re.search(r"at x (\S+), y (\S+), z (\S+) m: ", plain.err)
        assert float(at[1]) > 0.2 and (float(at[2]), float(at[3])) == pytest.approx((0.1, 0.1), abs=1e-9)
        assert plain.err.endswith("; positions are in the frame of --work\n")
        assert beeline("line", "panda", "--through", file, "--json", *work).json["reason"] == plain.err[9:-1]
    # A task whose rows are axes of the world, in a frame that is not upright: the world.
    tilted = beeline("line", "panda", "--through", "far.csv", "--task", "110001", "--degrees", "--work",
                     "0.3,0,0.2,20,0,30")
    assert tilted.code == 1 and "positions are in the world" in tilted.err


def test_unknown_groups_and_states_list_the_known_ones(refused, written):
    written("r.urdf", URDF)
    written("r.srdf", SRDF)
    arm = ("fk", "r.urdf", "--srdf", "r.srdf")
    refused(3, *arm, "--group", "amr", "--q", "home", says=["r.srdf: ", '"amr"', "arm, back"])
    refused(3, *arm, "--group", "arm", "--q", "hoome", says=["r.srdf: ", '"hoome"', "home, far"])
    refused(2, "fk", "r.urdf", "--tip", "tool0", "--q", "home", says=["--q: ", "--srdf"])
    refused(2, "fk", "panda", "--srdf", "r.srdf", "--group", "arm", "--q", Q["panda"],
            says=["URDF", "panda"])
    refused(2, "fk", "r.urdf", "--group", "arm", "--q", "0,0", says=["--group needs --srdf"])
    refused(3, "fk", "r.srdf", "--q", "0,0", says=["SRDF", "pass the URDF"])


def test_angles_beyond_a_revolution_get_a_warning(beeline, written):
    def warnings(*arguments):
        return [line for line in beeline(*arguments).err.splitlines() if "--degrees" in line]

    assert warnings("fk", "rrr", "--q", "90,0,0") == [
        "beeline: warning: --q: an angle of 90 rad is more than a revolution; "
        "--degrees reads degrees"
    ]
    assert warnings("fk", "rrr", "--q", "90,0,0", "--degrees") == []
    assert warnings("fk", "rrr", "--q", "6.283,-6.2832,0") == []
    assert len(warnings("ik", "rrr", "--pose", "3,3,90")) == 1
    assert len(warnings("ik", "ur5", "--pose", "0.4,0.1,0.3,180,0,0")) == 1
    assert warnings("ik", "ur5", "--pose", "0.4,0.1,0.3,1,0,0,0") == []
    assert len(warnings("fk", "rrr", "--q", "0,0,0", "--mount", "1,1,45")) == 1
    poses = written("p.csv", "x,y,theta\n4.5,5.2,0\n2,6,45\n")
    (line,) = warnings("line", "rrr", "--from", "0,1.57,0", "--through", poses)
    assert "--through p.csv" in line
    assert warnings("fk", "rp", "--q", "0,90") == []  # metres


def test_positions_are_poses_for_the_position_task(beeline, refused, written):
    plane = beeline("ik", "rrr", "--pose", "3,3", "--task", "position", "--json")
    assert plane.code == 0
    q = text(plane.json["solutions"][0])
    pose = beeline("fk", "rrr", "--q", q, "--json").json["pose"]["planar"]
    assert (pose["x"], pose["y"]) == pytest.approx((3, 3), abs=1e-8)
    space = beeline("ik", "panda", "--pose", "0.4,0.1,0.5", "--task", "position", "--json")
    found = beeline("fk", "panda", "--q", text(space.json["solutions"][0]), "--json").json["pose"]
    assert found["translation"] == pytest.approx([0.4, 0.1, 0.5], abs=1e-8)
    refused(2, "ik", "rrr", "--pose", "3,3", says=["--pose: x,y gives no orientation", "--task position"])
    refused(2, "ik", "panda", "--pose", "0.4,0.1,0.5",
            says=["--pose: x,y,z gives no orientation; give --task position, or x,y,z,roll"])
    refused(2, "ik", "panda", "--pose", "3,3", "--task", "position", says=["x,y is for planar arms"])
    poses = written("p.csv", "x;y;z\n0.4;0.1;0.5\n0.45;0;0.4\n")
    line = beeline("line", "panda", "--from", Q["panda"], "--through", poses, "--task", "position",
                   "--out", "m.csv", "--json")
    assert line.json["status"] == "reached" and line.err == ""
    assert beeline("check", "panda", "m.csv", "--through", poses, "--task", "position").code == 0
    refused(3, "line", "panda", "--from", Q["panda"], "--through", poses,
            says=["p.csv:2: x,y,z gives no orientation; give --task position"])


def test_a_file_without_a_header_is_read_with_a_warning(beeline, written):
    rows = "4.5,5.2,0\n2,6,0.5\n"
    line = ("line", "rrr", "--from", "0,1.57,0", "--json", "--through")
    named = beeline(*line, written("w.csv", "x,y,theta\n" + rows))
    bare = beeline(*line, written("b.csv", rows.replace(",", ";")))
    assert bare.json == named.json and named.err == ""
    assert bare.err == (
        "beeline: warning: b.csv has no header; its columns are read as x, y, theta\n")


def test_batch_reads_positions_and_semicolons(beeline, refused, written):
    written("p.csv", "x;y;z\n0.4;0.1;0.5\n")
    written("q.csv", "0.4,0.1,0.5\n")
    batch = ("batch", "ik", "panda", "--out", "-")
    answer = beeline(*batch, "--in", "p.csv", "--task", "position")
    assert answer.code == 0 and len(answer.out.splitlines()) == 2
    assert beeline(*batch, "--in", "q.csv", "--task", "position").out == answer.out
    refused(3, "batch", "ik", "panda", "--out", "q.npy", "--in", "p.csv", says=["p.csv:2", "--task position"])
    written("a.csv", "0;90;0\n")
    err = beeline("batch", "fk", "rrr", "--in", "a.csv", "--out", "f.csv").err
    assert "--in a.csv, row 1: an angle of 90 rad is more than a revolution" in err
    assert "revolution" not in beeline("batch", "fk", "rrr", "--in", "a.csv", "--out", "f.csv",
                                       "--degrees").err


def test_a_planar_pose_is_in_the_plane_of_the_arm(beeline):
    pose = ("ik", "rrr", "--mount", "0,0,0.7,0,0,0", "--json", "--pose")
    assert beeline(*pose, "3,3", "--task", "position").code == 0
    assert beeline(*pose, "3,3,0.5", "--task", "spatial").code == 0


def test_json_states_its_units(beeline, written):
    units = {"length": "m", "angle": "rad", "time": "s"}
    q = ("--q", "0.1,0.2,0.3", "--json")
    assert beeline("fk", "rrr", *q).json["units"] == units
    assert beeline("fk", "rrr", *q, "--degrees").json["units"] == {**units, "angle": "deg"}
    jacobian = beeline("jacobian", "rrr", *q, "--degrees").json["units"]
    assert jacobian["jacobian"] == "m or rad of the tool, per rad or m of the joint"
    far = beeline("ik", "rrr", "--pose", "30,3,0", "--json", "--degrees").json
    assert far["status"] == "unreachable" and far["units"]["residual"] == "m"
    assert beeline("move", "rrr", "--from", "0,0,0", "--to", "1,1,1", "--json").json["units"] == {
        **units, "error": "rad or m"}
    assert "units" not in beeline("arms", "--json").json
