"""Meshes, cells as URDF files, and the exemptions of SRDF files, as obstacles and as shapes of links."""

import json
import math
import os
import random
import struct
import subprocess

import pytest

# A wedge: the hull of the mesh is larger than the mesh, which has a hollow.
HOLLOW = [(0, 0, 0), (1, 0, 0), (1, 0.1, 0), (0.1, 0.1, 0), (0.1, 1, 0), (0, 1, 0)]


def obj(points):
    """A fan of triangles over two copies of a polygon."""
    lines = [f"v {x} {y} {z}" for z in (-0.5, 0.5) for x, y, _ in points]
    n = len(points)
    lines += [f"f {1 + i} {1 + (i + 1) % n} {n + 1 + i}" for i in range(n)]
    return "\n".join(lines) + "\n"


ARM = """<robot name="r">
<link name="base"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
<link name="upper"><collision><geometry><mesh filename="package://parts/bar.obj" scale="0.001 0.001 0.001"/></geometry>
</collision></link>
<link name="hand"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
<joint name="j1" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" velocity="2"/></joint>
<joint name="j2" type="revolute"><parent link="upper"/><child link="hand"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" velocity="2"/></joint>
</robot>
"""
BAR = [(0, -20, 0), (1000, -20, 0), (1000, 20, 0), (0, 20, 0)]  # in mm

CELL = """<robot name="cell"><link name="floor"/>
<link name="hook"><collision><geometry><mesh filename="hook.obj" scale="{mirror} 1 1"/></geometry></collision></link>
<link name="door"><collision><origin xyz="0 0.5 0"/><geometry><box size="0.02 1 1"/></geometry></collision></link>
<joint name="bolt" type="fixed"><parent link="floor"/><child link="hook"/><origin xyz="{x} {y} 0"/></joint>
<joint name="hinge" type="revolute"><parent link="floor"/><child link="door"/><origin xyz="0 -3 0"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3"/></joint></robot>
"""

MOVING = ("--moving-start", "--moving-end")


@pytest.fixture
def files(written, tmp_path):
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "bar.obj").write_text(obj(BAR))
    written("arm.urdf", ARM)
    written("hook.obj", obj(HOLLOW))
    written("cell.urdf", CELL.format(mirror=1, x=1.5, y=-1.5))
    written("still.csv", "t,j1,j2\n0,0,0\n1,0,0\n")
    return tmp_path


def check(beeline, *options):
    answer = beeline("check", "arm.urdf", "still.csv", *MOVING, "--json", *options)
    assert answer.code in (0, 1), answer.err
    return answer.json["clearance"]


def test_meshes_are_hulls_and_reports_say_so(beeline, written, files):
    clear = check(beeline, "--scene", "cell.urdf")
    assert clear["status"] == "clear" and clear["obstacles"] == ["hook", "door"]
    assert [(hull["body"], os.path.basename(hull["mesh"])) for hull in clear["mesh_hulls"]] == [
        ("upper", "bar.obj"), ("hook", "hook.obj")]
    assert clear["mesh_hulls"][0]["vertices"] == 8 and clear["mesh_hulls"][0]["padding"] == 0
    text = beeline("check", "arm.urdf", "still.csv", *MOVING, "--scene", "cell.urdf").out
    assert "meshes        taken as their convex hulls: upper, hook\n" in text
    # The bar ends in the hollow of the mirrored hook, which its hull fills.
    written("cell.urdf", CELL.format(mirror=-1, x=1.2, y=-0.3))
    hit = check(beeline, "--scene", "cell.urdf")
    assert hit["status"] == "collides" and hit["pair"] == ["upper", "hook"]
    assert "the meshes of upper and hook are taken as their convex hulls" in hit["reason"]


def test_distances_to_meshes(beeline, written, files):
    """The distance between the bar and a box as a mesh, at random places, is the distance of the boxes."""
    rng = random.Random(3)
    for _ in range(10):
        x, y = rng.uniform(0.2, 0.8), rng.uniform(0.2, 0.9)
        corners = [(x - 0.1, y, 0), (x + 0.1, y, 0), (x + 0.1, y + 0.1, 0), (x - 0.1, y + 0.1, 0)]
        written("hook.obj", obj(corners))
        written("cell.urdf", CELL.format(mirror=1, x=0, y=0))
        report = check(beeline, "--scene", "cell.urdf", "--hold", "hinge=-3")
        assert report["pair"] == ["upper", "hook"]
        assert report["lower"] <= y - 0.02 + 1e-9 and report["upper"] >= y - 0.02 - 1e-9
        assert 0.97 * (y - 0.02) < report["least_distance"] <= y - 0.02 + 1e-9


def test_joints_of_a_cell_are_held(beeline, files, refused):
    assert check(beeline, "--scene", "cell.urdf")["scenes_held"] == {"cell.urdf": {"hinge": 0}}
    open_door = check(beeline, "--scene", "cell.urdf", "--hold", "hinge=-0.5")
    assert open_door["scenes_held"] == {"cell.urdf": {"hinge": -0.5}} and open_door["held"] == {}
    text = beeline("check", "arm.urdf", "still.csv", *MOVING, "--scene", "cell.urdf", "--hold", "hinge=-0.5").out
    assert "held          hinge at -0.5 (cell.urdf)\n" in text
    command = ("check", "arm.urdf", "still.csv", "--scene", "cell.urdf")
    refused(2, *command, "--hold", "hinge=9", says=["--hold", "outside its limits"])
    refused(2, *command, "--hold", "hing=0", says=["hing"])


def test_packages(beeline, build, files, refused):
    (files / "parts").rename(files / "elsewhere")
    command = ("check", "arm.urdf", "still.csv", *MOVING, "--self")
    refused(3, *command, says=["arm.urdf:3", "upper", "package://parts/bar.obj", str(files / "parts" / "bar.obj"),
                               str(files.parent / "parts" / "bar.obj"), "--package parts=FOLDER"])
    assert beeline(*command, "--package", "parts=elsewhere").code == 0
    refused(3, *command, "--package", "parts=none", says=["looked for at none/bar.obj"])
    refused(2, *command, "--package", "parts", says=["--package must be NAME=FOLDER"])
    refused(2, *command, "--package", "parts=a", "--package", "parts=b", says=["two folders"])
    refused(2, "check", "arm.urdf", "still.csv", "--through", "a.csv", "--package", "parts=a",
            says=["--package needs --scene or --self"])
    for variable, folder in (("ROS_PACKAGE_PATH", "ros"), ("AMENT_PREFIX_PATH", "ros/share")):
        place = files / folder / "parts"
        place.parent.mkdir(parents=True, exist_ok=True)
        (files / "elsewhere").rename(place)
        answer = subprocess.run([build / "beeline", *command], capture_output=True, text=True, cwd=files,
                                env={**os.environ, variable: str(files / "ros")})
        assert answer.returncode == 0, answer.stderr
        place.rename(files / "elsewhere")
    assert beeline("fk", "arm.urdf", "--q", "0,0").code == 0, "the arm alone needs no meshes"
    moved = beeline("move", "arm.urdf", "--from", "0,0", "--to", "1,0", "--method", "quickest", "--out", "out.csv")
    assert moved.code == 0, moved.err


def test_links_of_a_cell_that_are_only_visible(beeline, written, files):
    table = """<link name="table"><visual><geometry><box size="9 9 9"/></geometry></visual></link>
        <joint name="foot" type="fixed"><parent link="floor"/><child link="table"/></joint></robot>"""
    written("cell.urdf", CELL.format(mirror=1, x=1.5, y=-1.5).replace("</robot>", table))
    answer = beeline("check", "arm.urdf", "still.csv", *MOVING, "--scene", "cell.urdf")
    assert answer.code == 0
    assert "warning: cell.urdf: links with <visual> and without <collision> are no obstacles: table\n" in answer.err
    assert "no shapes     table (cell.urdf)\n" in answer.out
    assert check(beeline, "--scene", "cell.urdf")["scenes_without_shapes"] == {"cell.urdf": ["table"]}


def test_a_collision_with_several_bodies_is_refused(files, written, refused):
    for inside in ('<geometry><sphere radius="1"/><box size="1 1 1"/></geometry>',
                   '<geometry><sphere radius="1"/></geometry><geometry><box size="1 1 1"/></geometry>'):
        written("arm.urdf", ARM.replace('<geometry><sphere radius="0.01"/></geometry>', inside, 1))
        refused(3, "check", "arm.urdf", "still.csv", "--self", says=["arm.urdf:2", "link base", "a second"])


def test_damaged_meshes(files, refused):
    (files / "parts" / "bar.obj").write_text("v 0 0 0\nf 1 2 3\n")
    refused(3, "check", "arm.urdf", "still.csv", "--self", says=["bar.obj:2", "vertex 2"])
    (files / "arm.urdf").write_text(ARM.replace("bar.obj", "bar.wrl"))
    refused(3, "check", "arm.urdf", "still.csv", "--self", says=["arm.urdf:3", "bar.wrl", "stl, obj", "convex_hull"])
    (files / "arm.urdf").write_text(ARM.replace("bar.obj", "bar.stl"))
    (files / "parts" / "bar.stl").write_bytes(b"\0" * 80 + struct.pack("<I", 10) + b"\0" * 49)
    refused(3, "check", "arm.urdf", "still.csv", "--self", says=["bar.stl", "10 triangles", "133"])


def test_exemptions_of_an_srdf_file(beeline, written, files):
    folded = written("folded.urdf", ARM.replace('<origin xyz="1 0 0"/>', '<origin xyz="0.005 0 0"/>'))
    command = ("check", folded, "still.csv", *MOVING, "--self", "--json")
    chain = """<link name="tool"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
        <joint name="j3" type="revolute"><parent link="hand"/><child link="tool"/><limit lower="-1" upper="1" velocity="2"/></joint>"""
    written("folded.urdf", (files / "folded.urdf").read_text().replace("</robot>", chain + "</robot>"))
    written("still.csv", "t,j1,j2,j3\n0,0,0,0\n1,0,0,0\n")
    report = beeline(*command).json["clearance"]
    assert report["status"] == "collides"
    pairs = {tuple(sorted(pair)) for pair in report["too_close"]}
    assert ("base", "tool") in pairs
    lines = "".join(f'<disable_collisions link1="{a}" link2="{b}" reason="Default"/>' for a, b in sorted(pairs))
    written("arm.srdf", f'<robot name="r">{lines}<disable_collisions link1="camera" link2="tool" reason="Never"/></robot>')
    report = beeline(*command, "--srdf", "arm.srdf").json["clearance"]
    assert report["status"] == "clear" and report["allowed_pairs"] == []
    assert {tuple(pair) for pair in report["srdf_pairs"]} == pairs
    text = beeline("check", folded, "still.csv", *MOVING, "--self", "--srdf", "arm.srdf").out
    assert "may touch     by arm.srdf: base and " in text and "camera" not in text


def test_a_mesh_of_many_triangles(beeline, files):
    """A sphere of 0.1 m; the hull is grown by less than 1 mm."""
    n = 300
    ring = [[(0.1 * math.sin(math.pi * i / n) * math.cos(2 * math.pi * k / n),
              0.1 * math.sin(math.pi * i / n) * math.sin(2 * math.pi * k / n), 0.1 * math.cos(math.pi * i / n))
             for k in range(n)] for i in range(n + 1)]
    record = struct.Struct("<12fH")
    with open(files / "parts" / "ball.stl", "wb") as out:
        out.write(b"\0" * 80 + struct.pack("<I", 2 * n * n))
        for i in range(n):
            upper, lower = ring[i], ring[i + 1]
            for k in range(n):
                a, b, c, d = upper[k - 1], upper[k], lower[k - 1], lower[k]
                out.write(record.pack(0, 0, 0, *a, *b, *c, 0) + record.pack(0, 0, 0, *b, *d, *c, 0))
    (files / "arm.urdf").write_text(ARM.replace("bar.obj", "ball.stl").replace("0.001", "1"))
    hull = check(beeline, "--self")["mesh_hulls"][0]
    assert hull["vertices"] <= 2000 and 0 < hull["padding"] < 1e-3


def test_a_scene_as_json_keeps_the_origin_of_hulls(beeline, written, files):
    hull = {"convex_hull": {"vertices": [[5, 5, 5], [6, 5, 5]]}, "hull_of": "bolt.stl", "padding": 1e-4}
    written("scene.json", json.dumps({"obstacles": [{"name": "bolt", "shapes": [hull]}]}))
    text = beeline("check", "arm.urdf", "still.csv", *MOVING, "--scene", "scene.json").out
    assert "meshes        taken as their convex hulls, grown by at most 0.0001 m: upper, bolt\n" in text
