"""--scene and --self: motions that are proved to hit nothing, refused where they do."""

import json
import math
import random
import shlex

import pytest

from shaped_arm import LENGTHS, planar_arm, trajectory

def scene(*obstacles, **keys):
    return json.dumps({"obstacles": list(obstacles), **keys})


def ball(name, position, radius=0.1, **keys):
    return {"name": name, "shapes": [{"sphere": {"radius": radius}, "pose": {"xyz": list(position)}}],
            **keys}


def tip(q):
    angles = [sum(q[: i + 1]) for i in range(3)]
    return (sum(a * math.cos(t) for a, t in zip(LENGTHS, angles)),
            sum(a * math.sin(t) for a, t in zip(LENGTHS, angles)))


MOVING = ("--moving-start", "--moving-end")


def check(beeline, arm, motion, *options):
    answer = beeline("check", arm, motion, *MOVING, "--json", *options)
    assert answer.code in (0, 1), answer.err
    return answer.json


def test_three_answers(beeline, arm, motion, written):
    far = written("far.json", scene(ball("far", (-5, -5, 0))))
    answer = beeline("check", arm, motion, *MOVING, "--scene", far)
    assert answer.code == 0 and answer.err == ""
    assert "passed: 2 samples in 4 s\n" in answer.out and "proved" in answer.out
    report = check(beeline, arm, motion, "--scene", far, "--no-self")
    proof = report["clearance"]
    assert report["status"] == "passed" and proof["status"] == "clear"
    assert set(proof["pair"]) == {"far", "link1"}
    assert 0.95 * proof["upper"] <= proof["least_distance"] <= proof["upper"]
    assert proof["reason"] == "" and proof["code"] is None

    x, y = tip((0.8, 0.4, 0.3))
    near = written("near.json", scene(ball("post", (x, y, 0))))
    answer = beeline("check", arm, motion, *MOVING, "--scene", near)
    assert answer.code == 1 and "collides" in answer.out
    assert answer.err.startswith("beeline: at ") and "--allow link3,post" in answer.err
    report = check(beeline, arm, motion, "--scene", near)
    proof = report["clearance"]
    assert report["status"] == proof["status"] == "collides"
    assert report["code"] == proof["code"] in ("bodies_collide", "bodies_too_close")
    assert proof["pair"] == ["link3", "post"] and proof["time"] < 2
    assert proof["fields"]["body"] == "link3" and proof["fields"]["time"] == proof["time"] == report["time"]

    # A sphere on the circle of the tip is at the clearance exactly.
    gap = 0.001
    radius = math.hypot(x, y) + 0.1 + gap + 0.1
    angle = math.atan2(y, x)
    grazing = written("grazing.json", scene(ball("post", (radius * math.cos(angle), radius * math.sin(angle), 0))))
    report = check(beeline, arm, motion, "--scene", grazing)
    assert report["status"] == "not_decided" == report["clearance"]["status"]
    assert report["code"] == "clearance_not_decided"
    assert report["clearance"]["begin"] <= 2.01 and report["clearance"]["end"] >= 1.99
    assert beeline("check", arm, motion, *MOVING, "--scene", grazing).code == 1
    assert check(beeline, arm, motion, "--scene", grazing, "--clearance", "0.0009")["status"] == "passed"
    assert check(beeline, arm, motion, "--scene", grazing, "--clearance", "0.0011")["status"] == "collides"


def test_thin_plates_and_wires_between_the_samples_are_found(beeline, written):
    """A body of 1 mm, at the tip at one time between two samples."""
    rng = random.Random(7)
    names = written("arm.json", json.dumps({
        "name": "planar", "joint_string": "RRR:3.5,3.5,2",
        "shapes": [{"joint": f"joint{i}", "shapes": [{"sphere": {"radius": 0.01}}]} for i in (1, 2, 3)]}))
    for case in range(25):
        rows = [(float(t), *(rng.uniform(-1, 1) + 0.4 * t * rng.uniform(-1, 1) for _ in range(3)))
                for t in range(3)]
        path = written("motion.csv", trajectory(*rows))
        time = rng.uniform(0, 2)
        k = min(int(time), 1)
        q = [a + (time - k) * (b - a) for a, b in zip(rows[k][1:], rows[k + 1][1:])]
        x, y = tip(q)
        kind = rng.choice([{"box": {"size": [0.001, 0.001, 0]}},
                           {"capsule": {"radius": 0.0005, "length": 0.05}},
                           {"cylinder": {"radius": 0.0005, "length": 0}}])
        pose = {"rpy": [rng.uniform(-3, 3) for _ in range(3)]}
        for height, expected in ((0.0, "collides"), (0.1, "passed")):
            thin = {"name": "thin", "shapes": [{**kind, "pose": {"xyz": [x, y, height], **pose}}]}
            plate = written("plate.json", scene(thin))
            report = check(beeline, names, path, "--scene", plate, "--no-self",
                           "--velocity", "9", "--acceleration", "99")
            assert report["status"] == expected, (case, report)
            if expected == "collides":
                assert report["clearance"]["time"] <= time + 1e-6
                assert report["clearance"]["pair"] == ["joint3", "thin"]


def test_links_against_each_other(beeline, arm, written):
    folded = written("folded.csv", trajectory((0.0, 0.0, 2.6, 2.0), (1.0, 0.0, 2.6, 2.4)))
    report = check(beeline, arm, folded, "--self")
    assert report["status"] == "collides"
    assert report["clearance"]["pair"] == ["link3", "link1"]
    answer = beeline("check", arm, folded, *MOVING, "--self")
    assert answer.code == 1 and "--allow link3,link1" in answer.err
    assert check(beeline, arm, folded, "--self", "--allow", "link3,link1")["status"] == "passed"
    allowed = check(beeline, arm, folded, "--self", "--allow", "link1,link3")["clearance"]
    assert allowed["allowed_pairs"] == [["link1", "link3"]]
    answer = beeline("check", arm, folded, *MOVING, "--self", "--allow", "link1,link3")
    assert "may touch     link1 and link3\n" in answer.out
    empty = written("empty.json", scene())
    assert check(beeline, arm, folded, "--scene", empty)["status"] == "collides"
    assert check(beeline, arm, folded, "--scene", empty, "--no-self")["status"] == "passed"


def test_a_clearance_of_an_obstacle_and_allowed_pairs_of_a_scene(beeline, arm, motion, written):
    x, y = tip((0.8, 0.4, 0.3))
    post = ball("post", (x + 1, y + 1, 0))
    assert check(beeline, arm, motion, "--scene", written("a.json", scene(post)))["status"] == "passed"
    wide = written("b.json", scene({**post, "clearance": 5}))
    assert check(beeline, arm, motion, "--scene", wide)["status"] == "collides"
    pairs = [["link3", "post"], ["post", "link2"], ["link1", "post"]]
    exempt = written("c.json", scene({**post, "clearance": 5}, allowed_pairs=pairs))
    report = check(beeline, arm, motion, "--scene", exempt)
    assert report["status"] == "passed" and report["clearance"]["allowed_pairs"] == pairs
    both = check(beeline, arm, motion, "--scene", "a.json", "--scene", written("d.json", scene(ball("far", (9, 9, 9)))))
    assert both["clearance"]["obstacles"] == ["post", "far"]


def test_faults_of_the_path_and_of_the_clearance_are_both_reported(beeline, arm, motion, written):
    x, y = tip((0.8, 0.4, 0.3))
    near = written("near.json", scene(ball("post", (x, y, 0))))
    poses = written("poses.csv", "x,y,theta\n1,1,0\n")
    report = check(beeline, arm, motion, "--scene", near, "--through", poses)
    assert report["status"] == "failed" and report["fault"] == "deviation"
    assert report["clearance"]["status"] == "collides"
    answer = beeline("check", arm, motion, *MOVING, "--scene", near, "--through", poses)
    assert answer.code == 1 and "post" in answer.err and "line 1" in answer.err
    slow = check(beeline, arm, motion, "--scene", near, "--velocity", "0.1")
    assert slow["fault"] == "velocity", "the limits are checked without --through"
    assert slow["status"] == "failed" and slow["clearance"]["status"] == "collides"


@pytest.mark.parametrize("verb", ["line", "move", "retime", "replay"])
def test_a_motion_that_collides_is_not_written(beeline, arm, written, tmp_path, verb):
    start, end = (0.2, 0.4, 0.3), (1.4, 0.4, 0.3)
    x, y = tip((0.8, 0.4, 0.3))
    written("near.json", scene(ball("post", (x, y, 0), 0.5)))
    written("far.json", scene(ball("post", (-5, -5, 0))))
    names = ",".join(map(repr, start)), ",".join(map(repr, end))
    if verb == "line":
        (x0, y0), (x1, y1) = tip(start), tip(end)
        written("near.json", scene(ball("post", ((x0 + x1) / 2, (y0 + y1) / 2, 0), 0.3)))
        written("poses.csv", f"x,y,theta\n{x1!r},{y1!r},{sum(end)!r}\n")
        command = ["line", arm, "--from", names[0], "--through", "poses.csv"]
    elif verb == "move":
        command = ["move", arm, "--from", names[0], "--to", names[1], "--method", "quickest"]
    else:
        written("recorded.csv", trajectory((0.0, *start), (2.0, 0.8, 0.4, 0.3), (4.0, *end)))
        command = [verb, arm, "recorded.csv"]
        if verb == "replay":
            assert beeline("move", arm, "--from", names[0], "--to", names[1], "--method", "quickest",
                           "--out", "recorded.csv").code == 0
    clear = beeline(*command, "--scene", "far.json", "--out", "out.csv", "--json")
    assert clear.code == 0, clear.err
    assert clear.json["clearance"]["status"] == "clear"
    assert (tmp_path / "out.csv").exists()
    again = beeline("check", arm, "out.csv", "--scene", "far.json", "--json").json
    assert again["clearance"]["least_distance"] == pytest.approx(
        clear.json["clearance"]["least_distance"], rel=0.02)
    (tmp_path / "out.csv").unlink()
    refused = beeline(*command, "--scene", "near.json", "--out", "out.csv", "--json")
    assert refused.code == 1 and refused.json["status"] == "collides"
    assert refused.json["code"] in ("bodies_collide", "bodies_too_close")
    assert refused.json["clearance"]["pair"][1] == "post"
    assert not (tmp_path / "out.csv").exists()
    assert refused.json["clearance"]["picture"] is None
    text = beeline(*command, "--scene", "near.json", "--out", "out.csv", "--draw", "hit.svg")
    assert text.code == 1 and "post" in text.err and not (tmp_path / "out.csv").exists()
    # The picture is of the time of the collision: the arm's own there, with the pair.
    time = f"{refused.json['clearance']['time']:.6g}"
    assert f"picture       hit.svg: the arm at {time} s" in text.out
    picture = (tmp_path / "hit.svg").read_text()
    assert f"at {time} s" in picture and "post" in picture


@pytest.mark.parametrize("form, out, options", [
    ("ros2", "out.yaml", ()), ("ros2", "out.yaml", ("--rate", "50")), ("csv", "out.csv", ("--rate", "100")),
    ("urscript", "out.script", ()), ("rapid", "out.mod", ("--rate", "20")), ("krl", "out.src", ("--rate", "20"))])
@pytest.mark.parametrize("program", [False, True])
def test_an_export_is_proved_clear_or_refused(beeline, written, tmp_path, form, out, options, program):
    if program and (form in ("ros2", "csv")):
        pytest.skip("the form holds trajectories")
    assert beeline("show", "ur5e", "--out", "ur5e.json").code == 0
    arm = json.loads((tmp_path / "ur5e.json").read_text())
    arm["shapes"] = [{"joint": joint["name"], "shapes": [{"sphere": {"radius": 0.05}}]} for joint in arm["joints"]]
    written("ur5e.json", json.dumps(arm))
    start, end = "0,-1.5,1.5,0,0,0", "0.5,-1,1,0,0.3,0"
    assert beeline("move", "ur5e.json", "--from", start, "--to", end, "--method", "quickest", "--out", "move.csv").code == 0
    if program:
        written("source.csv", "motion,q\njoint,\"0.5,-1,1,0,0.3,0\"\n")
        command = ["export", "ur5e.json", "source.csv", "--from", start]
    else:
        command = ["export", "ur5e.json", "move.csv", *options]
    command += ["--as", form, "--out", out, "--no-self", "--clearance", "0.02"]
    written("far cell.json", scene(ball("far", (-5, -5, 0))))
    place = beeline("fk", "ur5e", "--q", "0.25,-1.25,1.25,0,0.15,0", "--all", "--json").json["links"][5]["translation"]
    written("near.json", scene(ball("post", place)))

    clear = beeline(*command, "--scene", "far cell.json", "--json")
    assert clear.code == 0, clear.err
    assert clear.json["clearance"]["status"] == "clear"
    text = (tmp_path / out).read_text()
    comments = [line for line in text.splitlines() if line.lstrip()[:1] in "#!;"]
    assert any("May touch: by --no-self: all pairs of links" in line for line in comments)
    assert any("Clearance of 0.02 m from the obstacles of far cell.json: proved" in line for line in comments)
    if form == "ros2":
        assert not beeline("check", "ur5e.json", out, "--scene", "far cell.json").code
    repeated = next(line for line in comments if "Repeat this proof: beeline " in line).split("beeline ", 1)[1]
    (tmp_path / out).unlink()
    assert beeline(*shlex.split(repeated)).code == 0
    assert (tmp_path / out).read_text() == text
    (tmp_path / out).unlink()

    refused = beeline(*command, "--scene", "near.json", "--json")
    assert refused.code == 1 and refused.json["status"] == "collides"
    assert refused.json["code"] in ("bodies_collide", "bodies_too_close")
    assert refused.json["clearance"]["pair"][1] == "post" and refused.json["fields"]["other_body"] == "post"
    answer = beeline(*command, "--scene", "near.json")
    assert answer.code == 1 and "nothing is exported" in answer.err + answer.out and "--allow" in answer.err
    assert not (tmp_path / out).exists()
    near = json.loads((tmp_path / "near.json").read_text())
    near["obstacles"][0]["shapes"][0]["pose"]["xyz"][2] += 5
    written("own.json", json.dumps({"obstacles": [{**near["obstacles"][0], "clearance": 0.5}]}))
    assert beeline(*command, "--scene", "own.json").code == 0
    assert "Clearance of 0.02 m, or an obstacle's own, from" in (tmp_path / out).read_text()


def words_of(svg):
    return "\n".join(line for line in svg.splitlines() if line.startswith("<text"))


def test_pictures_show_the_scene(beeline, arm, motion, written, tmp_path):
    x, y = tip((0.8, 0.4, 0.3))
    far = written("far.json", scene(ball("far", (-3, -3, 0), 0.5), {"name": "floor", "shapes": [
        {"half_space": {}, "pose": {"xyz": [0, 0, -0.5]}}]}))
    near = written("near.json", scene(ball("post", (x, y, 0))))
    assert beeline("draw", arm, "--q", "0.8,0.4,0.3", "--scene", far, "--out", "a.svg").code == 0
    words = words_of((tmp_path / "a.svg").read_text())
    assert ">far<" in words and ">floor<" in words and "nearest: " in words and "0.400 m" in words
    assert beeline("draw", arm, "--q", "0.8,0.4,0.3", "--scene", near, "--out", "b.svg").code == 0
    assert "link3 and post overlap by 0.2" in words_of((tmp_path / "b.svg").read_text())
    assert beeline("draw", arm, motion, "--scene", near, "--out", "c.svg", "--animate", "d.svg").code == 0
    assert "overlap" in words_of((tmp_path / "c.svg").read_text()) and "at 2 s" in words_of((tmp_path / "c.svg").read_text())
    assert beeline("draw", arm, "--self", "--out", "e.svg").code == 0
    assert beeline("draw", arm, "--out", "f.svg").code == 0
    assert "nearest" not in words_of((tmp_path / "f.svg").read_text())

    assert beeline("check", arm, motion, *MOVING, "--scene", far, "--plot", "g.svg").code == 0
    assert beeline("check", arm, motion, *MOVING, "--scene", near, "--plot", "h.svg").code == 1
    assert beeline("check", arm, motion, *MOVING, "--through", written("p.csv", "x,y,theta\n1,1,0\n"),
                   "--plot", "i.svg").code == 1
    for name, shown in (("g.svg", True), ("h.svg", True), ("i.svg", False)):
        assert all((f">{word}<" in words_of((tmp_path / name).read_text())) == shown for word in
                   ("clearance", "sampled", "required")), name
    names = "0.2,0.4,0.3", "1.4,0.4,0.3"
    assert beeline("move", arm, "--from", names[0], "--to", names[1], "--scene", far, "--draw", "j.svg", "--plot", "k.svg").code == 0
    assert ">far<" in words_of((tmp_path / "j.svg").read_text()) and ">required<" in words_of((tmp_path / "k.svg").read_text())


URDF = """<robot name="r">
<link name="base"><collision><geometry><cylinder radius="0.1" length="0.2"/></geometry></collision></link>
<link name="upper"><collision><origin xyz="0.5 0 0"/><geometry><box size="1 0.1 0.1"/></geometry></collision></link>
<link name="hand"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<link name="finger"><collision><origin xyz="0.3 0 0"/><geometry><sphere radius="0.05"/></geometry></collision></link>
<joint name="j1" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="2"/></joint>
<joint name="j2" type="revolute"><parent link="upper"/><child link="hand"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" velocity="2"/></joint>
<joint name="grip" type="prismatic"><parent link="hand"/><child link="finger"/><axis xyz="0 1 0"/>
<limit lower="0" upper="0.5"/></joint>
</robot>
"""


def test_shapes_of_a_urdf_file(beeline, written):
    arm = written("arm.urdf", URDF)
    still = written("still.csv", "t,j1,j2\n0,0,0\n1,0,0\n")
    # The finger is at x 1.3, y 0 to 0.5.
    post = written("post.json", scene(ball("post", (1.3, 0.4, 0), 0.05)))
    ends = ("--tip", "hand")
    report = check(beeline, arm, still, *ends, "--scene", post)
    assert report["status"] == "passed" and report["clearance"]["held"] == {"grip": 0}
    assert report["clearance"]["links"] == ["base", "upper", "hand", "finger"]
    held = check(beeline, arm, still, *ends, "--scene", post, "--hold", "grip=0.4")
    assert held["status"] == "collides" and held["clearance"]["pair"] == ["finger", "post"]
    assert held["clearance"]["held"] == {"grip": 0.4}
    assert {"held_body": "finger", "held_joint": "grip", "held_value": 0.4}.items() <= held["clearance"]["fields"].items()
    states = "".join(f'<group_state name="{name}" group="hand"><joint name="{joint}" value="{value}"/></group_state>'
                     for name, joint, value in (("home", "j1", 0), ("far", "grip", 0.6), ("open", "grip", 0.4),
                                                ("close", "grip", 0)))
    srdf = written("arm.srdf", f'<robot name="r">{states}</robot>')
    opened = check(beeline, arm, still, *ends, "--scene", post, "--srdf", srdf)
    assert opened["status"] == "collides" and opened["clearance"]["pair"] == ["finger", "post"]
    assert opened["clearance"]["held"] == {"grip": 0.4}, "the first state that has a value within the limits"
    assert opened["clearance"]["held_by_state"] == {"grip": "open"} and held["clearance"]["held_by_state"] == {}
    given = beeline("check", arm, still, *MOVING, *ends, "--scene", post, "--srdf", srdf, "--hold", "grip=0.1")
    assert given.code == 0 and "held          grip at 0.1\n" in given.out
    text = beeline("check", arm, still, *MOVING, *ends, "--self", "--srdf", srdf).out
    assert "held          grip at 0.4 (state open of arm.srdf)\n" in text
    moved = check(beeline, arm, still, *ends, "--scene", post, "--mount", "0,0.4,0")
    assert moved["status"] == "collides", "the scene stays, the arm moves"
    tool = written("tool.json", json.dumps({"name": "probe", "shapes": [
        {"capsule": {"radius": 0.01, "length": 1}, "pose": {"rpy": [math.pi / 2, 0, 0]}}]}))
    probed = check(beeline, arm, still, *ends, "--scene", post, "--no-self", "--tool-shape", tool)
    assert probed["status"] == "passed"
    written("post.json", scene(ball("post", (1, 0.5, 0), 0.05)))
    probed = check(beeline, arm, still, *ends, "--scene", post, "--no-self", "--tool-shape", tool)
    assert probed["clearance"]["pair"] == ["probe", "post"]


def test_built_in_arms_have_shapes(beeline, written, tmp_path):
    """The same answers as with the arm's file; the mount moves the arm, and a tool is added."""
    q = "0,-0.785,0,-2.356,0,1.571,0.785"
    still = written("still.csv", "t," + ",".join(f"joint{i}" for i in range(1, 8)) + f"\n0,{q}\n1,{q}\n")
    post = written("post.json", scene(ball("post", (0.31, 0, 0.7), 0.02)))
    proof = check(beeline, "panda", still, "--scene", post)["clearance"]
    assert proof["status"] == "collides" and "post" in proof["pair"]
    assert check(beeline, "panda", still, "--scene", post, "--mount", "0,0.5,0")["clearance"]["status"] == "clear"
    assert check(beeline, "panda", still, "--self")["clearance"]["status"] == "clear"
    tool = written("hand.json", json.dumps({"name": "hand", "shapes": [{"sphere": {"radius": 0.01}, "pose": {"xyz": [0, 0, 0.2]}}]}))
    moved = check(beeline, "panda", still, "--scene", post, "--mount", "0,0.5,0", "--tool-shape", tool)["clearance"]
    assert moved["status"] == "clear" and moved["pairs"] > proof["pairs"]
    assert beeline("draw", "panda", "--scene", post, "--out", str(tmp_path / "a.svg")).code == 0
    assert "shapes of its links: the collision meshes of example-robot-data" in beeline("show", "panda").out
    assert "shapes of its links: none\n" in beeline("show", "fr3").out
    assert beeline("show", "fr3", "--json").json["shapes_source"] == ""


def test_refusals(refused, written, motion, beeline):
    arm, empty = written("arm.json", planar_arm()), written("empty.json", scene())
    refused(2, "check", "fr3", motion, "--scene", empty, says=["fr3 has no shapes", "<collision>", "\"shapes\""])
    refused(2, "check", "fr3", motion, "--self", says=["--self: fr3"])
    refused(2, "check", arm, motion, "--through", "a.csv", "--clearance", "1", says=["--clearance needs --scene"])
    refused(2, "check", arm, motion, "--self", "--no-self", says=["--no-self"])
    refused(2, "check", arm, motion, "--self", "--clearance", "0", says=["--clearance", "above 0"])
    refused(2, "check", arm, motion, "--self", "--resolution", "2", says=["--resolution"])
    refused(2, "check", arm, motion, "--self", "--allow", "link1", says=["--allow", "A,B"])
    refused(2, "check", arm, motion, "--self", "--allow", "link1,link4", says=["--allow", "link4", "link3"])
    refused(2, "check", arm, motion, "--self", "--hold", "finger", says=["--hold", "JOINT=VALUE"])
    refused(2, "check", arm, motion, "--self", "--hold", "finger=1", says=["--hold", "URDF"])
    refused(3, "check", arm, motion, "--scene", "none.json", says=["none.json"])
    bad = written("bad.json", scene({"name": "a", "shapes": [{"box": {"size": [1, 1]}}]}))
    refused(3, "check", arm, motion, "--scene", bad, says=["bad.json:1", "obstacles[0].shapes[0].box.size"])
    named = written("named.json", scene(ball("link1", (9, 9, 9))))
    refused(3, "check", arm, motion, "--scene", named, says=["named.json", "link1"])
    pairs = written("pairs.json", scene(allowed_pairs=[["link1", "tabel"]]))
    refused(3, "check", arm, motion, "--scene", pairs, says=["pairs.json", "allowed_pairs", "tabel"])
    refused(3, "check", arm, motion, "--scene", written("a.json", scene(ball("a", (9, 9, 9)))), "--scene",
            written("b.json", scene(ball("a", (9, 9, 9)))), says=["b.json", "\"a\""])
    huge = written("huge.json", scene(ball("a", (9, 9, 9), clearance=2e6)))
    refused(3, "check", arm, motion, "--scene", huge, says=["huge.json:1", "2e+06 m; it must be above 0 and at most 1e+06 m"])
    shapeless = written("shapeless.json", scene({"name": "table", "shapes": []}))
    refused(3, "check", arm, motion, "--scene", shapeless, says=["shapeless.json:1", "obstacles[0].shapes has no shape"])
    refused(3, "check", arm, motion, "--self", "--tool-shape", written("tool.json", '{"shapes": []}'), says=["no shape"])
    cone = written("cone.urdf", URDF.replace("<sphere radius=\"0.1\"/>", "<cone radius=\"1\"/>"))
    still = written("still.csv", "t,j1,j2\n0,0,0\n1,0,0\n")
    refused(3, "check", cone, still, "--tip", "hand", "--self", says=["cone.urdf:4", "hand", "<cone>", "<mesh>"])
    refused(2, "draw", "fr3", "--scene", empty, "--out", "a.svg", says=["fr3 has no shapes"])
    refused(2, "draw", arm, "--scene", "a.svg", "--out", "a.svg", says=["a.svg"])
    refused(2, "draw", arm, "--clearance", "1", "--out", "a.svg", says=["--clearance needs --scene"])
    refused(2, "export", arm, motion, "--as", "ros2", "--out", "a.yaml", "--allow", "a,b", says=["--allow needs --scene"])
    refused(2, "move", arm, "--from", "0,0,0", "--to", "1,0,0", "--scene", empty, "--out", empty, says=[empty])
    partial = written("partial.json", json.dumps({"name": "a", "joint_string": "RRR", "shapes": [
        {"joint": "joint3", "shapes": [{"sphere": {"radius": 0.1}}]}]}))
    answer = beeline("check", partial, motion, *MOVING, "--self")
    assert "warning: links without shapes are not checked: after joint1, after joint2" in answer.err


def test_a_search_ends_with_its_time(beeline, arm, motion, written):
    far = written("far.json", scene(ball("far", (-5, -5, 0))))
    report = check(beeline, arm, motion, "--scene", far, "--time-limit", "0")
    assert report["status"] == "time_limit" and report["code"] == "ended_before_check"
    answer = beeline("check", arm, motion, *MOVING, "--scene", far, "--time-limit", "1e-9")
    assert answer.code == 1 and answer.err.count("time limit") == 1, answer.err
