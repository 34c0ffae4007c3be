"""--rail and --mobile-base: an arm that is moved as a whole."""

import json

import pytest

from arms import Q
from frames_test import SRDF, URDF, frame, matrix, product, same

RAIL, BASE = ("--rail", "y:-0.5:2"), ("--mobile-base", "-2:2,-1:1,-3:3")
POSES = "x,y,z,roll,pitch,yaw\n0.5,0.3,0.4,180,0,0\n2.6,0.3,0.4,180,0,20\n2.6,-0.3,0.5,180,0,20\n"


@pytest.mark.parametrize("arm", ["ur5", "panda", "stanford"])
def test_fk_is_the_arm_moved(beeline, arm):
    frames = ("--mount", "1,2,0.7,0,0.2,1.5", "--tcp", "0.1,0,0.2")
    alone = matrix(beeline("fk", arm, "--q", Q[arm], "--json", *frames))
    rail = beeline("fk", arm, "--q", f"0.75,{Q[arm]}", "--json", *RAIL, *frames)
    assert same(matrix(rail), product(frame(y=0.75), alone))
    slanted = beeline("fk", arm, "--q", f"0.5,{Q[arm]}", "--json", "--rail", "3,0,-4:1", *frames)
    assert same(matrix(slanted), product(frame(0.3, 0, -0.4), alone))
    moved = beeline("fk", arm, "--q", f"0.5,-0.25,0.3,{Q[arm]}", "--json", *BASE, *frames)
    assert same(matrix(moved), product(frame(0.5, -0.25, yaw=0.3), alone))
    both = beeline("fk", arm, "--q", f"0.5,-0.25,0.3,0.75,{Q[arm]}", "--json", *BASE, *RAIL, *frames)
    assert same(matrix(both), product(frame(0.5, -0.25, yaw=0.3), frame(y=0.75), alone))


def test_show_lists_the_joints_with_limits_that_files_give(beeline, written):
    limits = written("l.json", '{"rail": {"velocity": 0.8, "upper": 1}}')
    shown = beeline("show", "ur5", *RAIL, "--limits", limits, "--json").json
    assert shown["dof"] == 7
    assert shown["joints"][0] == {
        "name": "rail", "type": "prismatic", "link": "carriage",
        "limits": {"lower": -0.5, "upper": 1, "velocity": 0.8, "acceleration": None, "jerk": None},
        "assumed": {"acceleration": pytest.approx(3.2), "jerk": pytest.approx(32)}}
    shown = beeline("show", "rrr", "--mobile-base", "-2:2,-1:1,-90:90", "--degrees", "--json",
                    "--velocity", "1,1,30,90,90,90").json["joints"]
    assert [joint["name"] for joint in shown[:3]] == ["base_x", "base_y", "base_heading"]
    assert [joint["limits"]["upper"] for joint in shown[:3]] == [2, 1, pytest.approx(90)]
    assert [joint["limits"]["velocity"] for joint in shown[:3]] == [1, 1, pytest.approx(30)]
    free = beeline("show", "rrr", "--mobile-base", "-2:2,-1:1", "--json").json["joints"][2]
    assert free["limits"]["lower"] is None and free["limits"]["upper"] is None


@pytest.mark.parametrize("ending", ["json", "urdf", "xml"])
@pytest.mark.parametrize("options", [RAIL, BASE])
def test_written_arms_read_back(beeline, options, ending):
    q = ",".join(["0.3"] * (1 if options == RAIL else 3)) + "," + Q["ur5"]
    mount = ("--mount", "0.1,0.2,0.5,0,0,1")
    assert beeline("show", "ur5", *options, *mount, "--out", f"a.{ending}").code == 0
    direct = beeline("fk", "ur5", *options, *mount, "--q", q, "--json")
    assert same(matrix(beeline("fk", f"a.{ending}", "--q", q, "--json")), matrix(direct))
    again = beeline("fk", f"a.{ending}", "--rail", "z:1", "--q", f"0.25,{q}", "--json")  # rail2
    assert same(matrix(again), product(frame(z=0.25), matrix(direct)))


def test_ik_finds_the_arm_on_its_rail_in_closed_form(beeline):
    pose = ("--pose", "2.2,0.4,0.4,180,0,0", "--degrees", "--json")
    assert beeline("ik", "ur5", *pose).json["status"] == "unreachable"
    found = beeline("ik", "ur5", "--rail", "x:3", *pose).json
    assert found["status"] == "solved" and found["method"].startswith("closed form")
    locked = beeline("ik", "ur5", "--rail", "x:3", *pose, "--all", "--lock", "rail=2").json
    assert [q[0] for q in locked["solutions"]] == [2] * len(locked["solutions"])
    alone = beeline("ik", "ur5", "--pose", "0.2,0.4,0.4,180,0,0", "--degrees", "--json", "--all").json
    assert locked["complete"] and len(locked["solutions"]) == len(alone["solutions"]) == 8


@pytest.mark.parametrize("arm, options", [
    ("ur5", ("--rail", "x:3")), ("panda", ("--rail", "x:3")), ("ur5", ("--mobile-base", "-3:3,-3:3")),
    ("panda", ("--mobile-base", "0:3,-1:1,-90:90", "--rail", "z:0.3"))])  # fmt: skip
def test_lines_beyond_the_arms_reach_are_planned_and_proved(beeline, written, arm, options):
    poses = written("p.csv", POSES)
    line = ("line", arm, "--through", poses, "--degrees", "--json")
    assert beeline(*line).json["status"] != "reached"
    planned = beeline(*line, *options, "--out", "o.csv")
    assert planned.json["status"] == "reached", planned.err
    assert beeline("check", arm, "o.csv", *options, "--through", poses, "--degrees").code == 0
    assert beeline("draw", arm, "o.csv", *options, "--degrees", "--out", "o.svg").code == 0
    assert beeline("retime", arm, "o.csv", *options, "--degrees", "--out", "r.csv").code == 0


def test_moves_and_batches_have_the_longer_configurations(beeline, written):
    start, goal = f"0,{Q['ur5']}", f"1.5,{Q['ur5']}"
    moved = beeline("move", "ur5", *RAIL, "--from", start, "--to", goal, "--method", "quickest", "--json", "--out", "m.csv")
    assert moved.json["status"] == "reached"
    header = "rail,joint1,joint2,joint3,joint4,joint5,joint6\n"
    written("q.csv", header + start + "\n" + goal + "\n")
    assert beeline("batch", "fk", "ur5", *RAIL, "--in", "q.csv", "--out", "p.csv").code == 0
    assert beeline("batch", "ik", "ur5", *RAIL, "--in", "p.csv", "--out", "-").code == 0


def test_controllers_of_six_axes_refuse_the_rail(beeline, refused):
    beeline("move", "ur5", *RAIL, "--from", f"0,{Q['ur5']}", "--to", f"1,{Q['ur5']}", "--method", "quickest", "--out", "m.csv")
    refused(2, "export", "ur5", *RAIL, "m.csv", "--as", "krl", "--out", "m.src", says=["six revolute joints", "rail"])
    assert beeline("export", "ur5", *RAIL, "m.csv", "--as", "ros2", "--out", "m.yaml").code == 0


def test_named_states_have_the_moving_base_at_zero(beeline, written):
    srdf = ("--srdf", written("r.srdf", SRDF), "--group", "arm")
    written("r.urdf", URDF)
    home = matrix(beeline("fk", "r.urdf", *srdf, "--q", "home", "--json"))
    assert same(matrix(beeline("fk", "r.urdf", *srdf, *BASE, *RAIL, "--q", "home", "--json")), home)
    away = beeline("fk", "r.urdf", *srdf, "--rail", "x:0.5:2", "--q", "home", "--json")  # next to 0
    assert same(matrix(away), product(frame(x=0.5), home))
    states = beeline("show", "r.urdf", *srdf, *RAIL).out
    assert "0, 0.25, -0.5" in states


def test_the_base_of_the_arm_hits_what_stands_beside_the_rail(beeline, written):
    """The links are carried, with the base, which then is a moving link."""
    post = [{"name": "post", "shapes": [{"sphere": {"radius": 0.1}, "pose": {"xyz": [1, 0, 0.02]}}]}]
    scene = ("--scene", written("s.json", json.dumps({"obstacles": post})), "--json")
    up = "0,-1.57,0,0,0,0"
    for options, base in ((("--rail", "x:2"), ["rail"]),
                          (("--mobile-base", "0:2,-1:1"), ["base_x", "base_y", "base_heading"])):
        names = ",".join(["t", *base, *(f"joint{i + 1}" for i in range(6))]) + "\n"
        zeros = ",0" * (len(base) - 1)
        for name, x in ("near.csv", 0.5), ("far.csv", 1.5):
            written(name, names + f"0,0{zeros},{up}\n2,{x}{zeros},{up}\n")
        ends = ("--moving-start", "--moving-end")
        assert beeline("check", "ur5", "near.csv", *options, *scene, *ends).code == 0
        hit = beeline("check", "ur5", "far.csv", *options, *scene, *ends)
        assert hit.code == 1 and "base_link" in hit.err and "post" in hit.err
        assert "links without shapes" not in hit.err


def test_self_collisions_do_not_depend_on_the_base(beeline):
    pose = ("--pose", "0.4,0.3,0.4,3.1,0,0", "--all", "--self", "--json")
    alone = beeline("ik", "ur5", *pose).json
    rail = beeline("ik", "ur5", "--rail", "x:0:1", "--lock", "rail=0", *pose).json
    assert len(rail["solutions"]) == len(alone["solutions"])
    assert len(rail["blocked"]) == len(alone["blocked"]) > 0


def test_limits_in_millimetres_are_noticed(beeline):
    for options in ("--rail", "x:2000"), ("--rail", "x:-500:0"), ("--mobile-base", "0:1,0:3000"):
        warning = beeline("show", "ur5", *options).err
        assert warning.startswith(f"beeline: warning: {options[0]}: the limit ") and "millimetres" in warning
    assert beeline("show", "ur5", "--rail", "x:100").err == ""


def test_bad_rails_and_bases_name_their_option(refused):
    q = ("fk", "ur5", "--q", "0," + Q["ur5"])
    for text, says in (("x", "AXIS:LENGTH"), ("x:1:2:3", "AXIS:LENGTH"), ("w:1", "x, y, z or a direction"),
                       ("1,2:1", "2 numbers"), ("0,0,0:1", "the axis of a rail has the length 0"), ("x:0", "above 0 m"),
                       ("x:-1", "above 0 m"), ("x:a", "the length"), ("x:2:1", "joint 1 (rail)"), ("x:1e9", "joint 1 (rail)"),
                       ("x:nan", "the length")):  # fmt: skip
        refused(2, *q, "--rail", text, says=["--rail", says])
    for text, says in (("1", "XMIN:XMAX"), ("0:1", "XMIN:XMAX"), ("0:1,0:1,0:1,0:1", "XMIN:XMAX"), ("0:1,2", "XMIN:XMAX"),
                       ("0:1,0:x", "a limit"), ("0:1,1:0", "joint 2 (base_y)"), ("0:1,0:1,", "XMIN:XMAX")):  # fmt: skip
        refused(2, *q, "--mobile-base", text, says=["--mobile-base", says])
    refused(2, "fk", "ur5", "--q", Q["ur5"], *RAIL, says=["7 joint values (rail, joint1"])


def test_places_are_not_searched_for_an_arm_that_moves(beeline, refused, written):
    """The mounts would turn the rail, which --mount does not."""
    poses = written("p.csv", "x,y,theta\n0,6,0\n")
    for name, options in ("rail", ("--rail", "x:4")), ("base", ("--mobile-base", "0:4,0:1")):
        assert beeline("reach", "map", "rrr", *options, "--resolution", "2", "--out", f"{name}.h5").code == 0
        refused(2, "reach", "place", f"{name}.h5", "--poses", poses, says=["rail or a mobile base", "without"])
    refused(2, "reach", "place", "rail.h5", "--poses", poses, "--rail", "x:4", says=["--rail"])


BOX = '<collision><origin xyz="{}"/><geometry><box size="{}"/></geometry></collision>'
CELL = f"""<robot name="cell">
<link name="ROOT"/>
<link name="base_link">{BOX.format("0 0 0.05", "0.2 0.2 0.1")}</link>
<link name="table">{BOX.format("1.5 0 0.4", "0.2 0.2 0.2")}</link>
<link name="arm">{BOX.format("0 0 0.25", "0.1 0.1 0.5")}</link>
<joint name="foot" type="fixed"><parent link="ROOT"/><child link="base_link"/></joint>
<joint name="legs" type="fixed"><parent link="ROOT"/><child link="table"/></joint>
<joint name="turn" type="revolute"><parent link="base_link"/><child link="arm"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
</robot>"""


@pytest.mark.parametrize("ends", [(), ("--base", "base_link")])
def test_a_table_of_the_world_stands_while_the_carriage_moves(beeline, written, ends):
    written("t.csv", "t,rail,turn\n0,0,0\n2,1.9,0\n")
    for root, code in ("world", 1), ("platform", 0):
        written("c.urdf", CELL.replace("ROOT", root))
        checked = beeline("check", "c.urdf", "t.csv", "--rail", "x:2", "--self", "--moving-start", "--moving-end", *ends)
        assert checked.code == code, checked.err
        assert code == 0 or "table" in checked.err and "arm" in checked.err


def test_bodies_without_shapes_on_the_carriage_are_named(beeline, written):
    sphere = [{"sphere": {"radius": 0.01}}]
    written("a.json", json.dumps({"name": "a", "joint_string": "RR:1,1", "shapes": [
        {"name": "foot", "shapes": []}, {"joint": "joint1", "shapes": sphere}, {"joint": "joint2", "shapes": sphere}]}))
    for options in (), ("--rail", "x:1"):
        err = beeline("ik", "a.json", "--pose", "1,1", "--task", "110", "--self", *options).err
        assert "links without shapes are not checked: " in err and "foot" in err


def test_scenes_in_a_frame_that_moves_are_refused(refused, written):
    written("c.urdf", CELL.replace("ROOT", "world"))
    scene = written("s.yaml", "world: {collision_objects: [{id: b, header: {frame_id: base_link}, primitives: "
                              "[{type: 2, dimensions: [0.1]}], primitive_poses: [{position: [3, 0, 0]}]}]}\n")
    said = ["base_link", "moves with the arm's base", "in the world"]
    refused(3, "ik", "c.urdf", "--pose", "0,0,0", "--task", "position", "--scene", scene, "--rail", "x:1", says=said)


def test_headings_in_degrees_and_mixed_units_are_noticed(beeline):
    heading = ("--mobile-base", "0:1,0:1,-90:90")
    assert "--mobile-base" in beeline("show", "ur5", *heading).err
    assert beeline("show", "ur5", *heading, "--degrees").err == ""
    speed = ("--rail", "x:1", "--degrees", "--velocity")
    assert "in metres for rail" in beeline("show", "ur5", *speed, "90").err
    assert beeline("show", "ur5", *speed, "1,90,90,90,90,90,90").err == ""
    assert beeline("show", "ur5", "--degrees", "--velocity", "90").err == ""


def test_columns_have_the_makers_names_behind_the_rail(beeline, written):
    names = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"]
    written("m.csv", ",".join(["t", "rail", *(f"{name}_joint" for name in names)]) + f"\n0,0,{Q['ur5']}\n3,0.5,{Q['ur5']}\n")
    assert beeline("retime", "ur5", "m.csv", "--rail", "x:1", "--out", "r.csv").code == 0
