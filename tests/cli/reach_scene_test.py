"""Reach maps and placements in a scene."""

import json
import math

from shaped_arm import planar_arm

ARM = planar_arm()
POST = json.dumps({"obstacles": [{"name": "post", "shapes": [
    {"cylinder": {"radius": 0.3, "length": 2}, "pose": {"xyz": [2.1, 1.3, 0]}}]}]})
FAR = json.dumps({"obstacles": [{"name": "far", "shapes": [{"sphere": {"radius": 1}, "pose": {"xyz": [50, 0, 0]}}]}]})


def test_a_map_of_a_scene_counts_free_solutions(beeline, written, tmp_path):
    arm, post, far = written("arm.json", ARM), written("post.json", POST), written("far.json", FAR)
    grid = ["--resolution", "1.5", "--directions", "90", "--degrees"]
    cells = lambda name, *options: beeline("reach", "map", arm, *grid, "--out", tmp_path / name, *options, "--json")
    whole, free = cells("all.h5"), cells("free.h5", "--scene", post, "--clearance", "0.05")
    away = cells("far.h5", "--scene", far, "--no-self")
    assert away.json["cells_reached"] == whole.json["cells_reached"] > free.json["cells_reached"] > 0
    assert free.json["scene"]["clearance"] == free.json["map_scene"]["clearance"] == 0.05
    assert free.json["map_scene"]["files"] == [str(post)] and whole.json["map_scene"] is None
    text = beeline("reach", "query", tmp_path / "free.h5").out
    assert f"free in       {post}, 0.05 m are required" in text
    sliced = beeline("reach", "slice", tmp_path / "free.h5", "--at", "z=0", "--out", tmp_path / "slice.csv")
    assert f"free in       {post}, 0.05 m are required" in sliced.out
    compared = beeline("reach", "compare", tmp_path / "all.h5", tmp_path / "free.h5")
    assert "free.h5: free in " in compared.out and "all.h5: free" not in compared.out
    merged = beeline("reach", "merge", tmp_path / "far.h5", tmp_path / "free.h5", "--out", tmp_path / "m.h5")
    assert merged.code == 3 and "another map: its scene is" in merged.err
    placed = beeline("reach", "place", tmp_path / "free.h5", "--poses", written("p.csv", "x,y,theta\n1,2,0\n"))
    assert placed.code == 2 and "without a scene" in placed.err


def test_a_map_of_a_scene_has_rolls_and_no_azimuths(beeline, written, tmp_path):
    assert beeline("show", "ur5", "--out", tmp_path / "ur5.json").code == 0
    ur5 = json.loads((tmp_path / "ur5.json").read_text())
    ur5["shapes"] = [{"joint": "joint6", "shapes": [{"sphere": {"radius": 0.05}}]}]
    arm, far = written("shaped.json", json.dumps(ur5)), written("far.json", FAR)
    command = ["reach", "map", arm, "--resolution", "0.5", "--scene", far, "--out", tmp_path / "m.h5"]
    assert "--rolls" in beeline(*command).err
    assert "--azimuths" in beeline(*command, "--azimuths", "1").err
    assert beeline(*command, "--rolls", "3").code == 0


def test_mounts_whose_solutions_are_blocked_are_left_out(beeline, written, tmp_path):
    arm, post, far = written("arm.json", ARM), written("post.json", POST), written("far.json", FAR)
    poses = written("poses.csv", "x,y,theta\n4,3,0\n4,4,0\n")
    assert beeline("reach", "map", arm, "--resolution", "1.5", "--out", tmp_path / "m.h5").code == 0
    command = ["reach", "place", tmp_path / "m.h5", "--poses", poses, "--step", "1", "--count", "100", "--json"]
    alone, away = beeline(*command).json, beeline(*command, "--scene", far, "--arm", arm, "--no-self").json
    assert away["placements"] == alone["placements"] and away["blocked"] == 0
    near = beeline(*command, "--scene", post, "--arm", arm).json
    assert 0 < near["blocked"] < near["reaching"] == alone["reaching"]
    for placement in near["placements"][:3]:
        for pose, q in zip(("4,3,0", "4,4,0"), placement["solutions"]):
            ik = beeline("ik", arm, "--mount", placement["mount"], "--pose", pose, "--scene", post, "--all", "--json")
            assert min(math.dist(q, s) for s in ik.json["solutions"]) < 1e-4  # the mount is rounded
    assert "--arm" in beeline(*command, "--scene", post).err
    assert "other joints" in beeline(*command, "--scene", post, "--arm", "RRR:1,1,1").err


def test_mounts_whose_base_is_in_an_obstacle_are_left_out(beeline, written, tmp_path):
    """The tool's bodies alone would be free: the pedestal is not."""
    bodies = [{"name": "pedestal", "shapes": [{"cylinder": {"radius": 0.3, "length": 0.4}}]},
              {"joint": "joint3", "name": "hand", "shapes": [{"sphere": {"radius": 0.1}}]}]
    arm = written("arm.json", json.dumps({"name": "planar", "joint_string": "RRR:3.5,3.5,2", "shapes": bodies}))
    cell = lambda top: json.dumps({"obstacles": [{"name": "crate", "shapes": [
        {"box": {"size": [2, 2, 2]}, "pose": {"xyz": [0, 0, top - 1]}}]}]})
    poses = written("poses.csv", "x,y,theta\n4,3,0\n")
    assert beeline("reach", "map", arm, "--resolution", "1.5", "--out", tmp_path / "m.h5").code == 0
    command = ["reach", "place", tmp_path / "m.h5", "--poses", poses, "--lower=-3,0,0", "--upper=3,0,0", "--step", "0.5",
               "--headings", "1", "--count", "100", "--arm", arm, "--no-self", "--scene"]
    places = lambda scene, *more: sorted(float(one["mount"].split(",")[0])
                                         for one in beeline(*command, scene, *more, "--json").json["placements"])
    standing, inside = written("floor.json", cell(-0.2)), written("crate.json", cell(0.5))
    allowed = places(inside, "--allow", "pedestal,crate")
    assert places(standing) == allowed and 0.0 in allowed
    assert places(inside) == [x for x in allowed if abs(x) > 1.3]
    text = beeline(*command, inside).out
    assert " left out: blocked in the scene\n  the first: pedestal and crate collide at " in text, text


def test_obstacles_that_the_mount_would_move_are_refused(beeline, written, tmp_path):
    """A scene of MoveIt may give a pose in a link of the base, which ik --mount moves."""
    box = '<collision><origin xyz="0.5 0 0"/><geometry><box size="1 .1 .1"/></geometry></collision>'
    links = '<link name="world"/><link name="base_link"/>' + "".join(f'<link name="l{k}">{box}</link>' for k in (1, 2, 3))
    joints = "".join(f'<joint name="j{k}" type="continuous"><parent link="{parent}"/><child link="l{k}"/>'
                     f'<origin xyz="{0 if k == 1 else 1} 0 0"/><axis xyz="0 0 1"/></joint>'
                     for k, parent in ((1, "base_link"), (2, "l1"), (3, "l2")))
    arm = written("u.urdf", f'<robot name="u">{links}<joint name="stand" type="fixed"><parent link="world"/>'
                            f'<child link="base_link"/><origin xyz="0.1 0 0"/></joint>{joints}</robot>')
    scene = "name: s\nworld:\n  collision_objects:\n    - header: {{frame_id: {}}}\n      id: box\n" \
        "      primitives: [{{type: 1, dimensions: [0.1, 0.1, 0.1]}}]\n" \
        "      primitive_poses: [{{position: {{x: 9, y: 0, z: 0}}, orientation: {{x: 0, y: 0, z: 0, w: 1}}}}]\n"
    assert beeline("reach", "map", arm, "--resolution", "1", "--out", tmp_path / "u.h5").code == 0
    command = ["reach", "place", tmp_path / "u.h5", "--poses", written("p.csv", "x,y,theta\n1,1,0\n"), "--arm", arm, "--scene"]
    fixed = beeline(*command, written("fixed.yaml", scene.format("world")))
    assert fixed.code == 0, fixed.err
    moved = beeline(*command, written("moved.yaml", scene.format("base_link")))
    assert moved.code not in (0, 1) and moved.err.count("\n") == 1 and "base_link" in moved.err, moved.err
