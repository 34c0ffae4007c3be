"""--scene of point clouds: the answers equal the answers for a scene with a sphere for each point."""

import json
import random

import numpy as np

from random_cases import cases

MOVING = ("--moving-start", "--moving-end")
NAMES = ("reason", "point", "fields", "sentence")  # that say which point it is


def ply(points):
    front = f"ply\nformat ascii 1.0\nelement vertex {len(points)}\n"
    axes = "".join(f"property double {axis}\n" for axis in "xyz")
    return front + axes + "end_header\n" + "".join(" ".join(map(repr, p)) + "\n" for p in points)


def without_names(value):
    if isinstance(value, dict):
        return {key: without_names(item) for key, item in value.items() if key not in NAMES}
    return [without_names(item) for item in value] if isinstance(value, list) else value


def test_a_cloud_is_a_sphere_for_each_point(beeline, arm, motion, written, tmp_path):
    seed = random.randrange(2**32)
    print("seed", seed)
    rng = random.Random(seed)
    codes = set()
    goal = written("goal.csv", "x,y,theta\n4,5,1.3\n")
    for _ in range(cases(12)):
        radius = rng.choice([0.02, 0.1, 0.4])
        points = [[round(rng.uniform(-9, 9), 3) for _ in range(3)] for _ in range(rng.randint(1, 60))]
        shapes = [{"sphere": {"radius": radius}, "pose": {"xyz": p}} for p in points]
        spheres = written("spheres.json", json.dumps({"obstacles": [{"name": "scan", "shapes": shapes}]}))
        named = {"name": "scan", "point_cloud": {"radius": radius, "file": "scan.npy"}}
        np.save(tmp_path / "scan.npy", points)
        scenes = [("--scene", written("scan.ply", ply(points)), "--radius", radius),
                  ("--scene", "scan.npy", "--radius", radius),
                  ("--scene", written("named.json", json.dumps({"obstacles": [named]})))]
        for command in (("check", arm, motion, *MOVING), ("ik", arm, "--pose=4,4,0.5", "--all"),
                        ("line", arm, "--from", "0.5,0.4,0.3", "--through", goal, "--out", "line.csv")):
            expected = beeline(*command, "--scene", spheres, "--json")
            codes.add(expected.code)
            assert expected.code in (0, 1), expected.err
            for scene in scenes:
                answer = beeline(*command, *scene, "--json")
                assert answer.code == expected.code, (command, answer.err)
                assert without_names(answer.json) == without_names(expected.json), (command, scene)
    assert 0 in codes


def test_the_point_that_is_hit_has_its_index(beeline, arm, motion, written):
    far, hit = [[-5, -5, 0], [-5.5, -5, 0]], [4.5, 5.0, 0]
    name = written("scan.ply", ply([*far, hit]))
    answer = beeline("check", arm, motion, *MOVING, "--scene", name, "--radius", 2)
    assert answer.code == 1 and "scan[2]" in answer.err and answer.err.count(",scan") == 1
    assert "--allow" in answer.err and "scan[2]" not in answer.err.split("--allow")[1]
    proof = beeline("check", arm, motion, *MOVING, "--scene", name, "--radius", 2, "--json").json["clearance"]
    assert proof["pair"][1] == "scan" and proof["point"] == proof["fields"]["point"] == 2
    links = [("--allow", f"link{k},scan") for k in (1, 2, 3)]
    allowed = beeline("check", arm, motion, *MOVING, "--scene", name, "--radius", 2, *sum(links, ()))
    assert allowed.code == 0, allowed.err
    clear = beeline("check", arm, motion, *MOVING, "--scene", written("far.ply", ply(far)), "--radius", 0.1, "--no-self")
    assert clear.code == 0 and "far[0]" in clear.out


def test_what_is_no_cloud_is_refused(refused, arm, motion, written, tmp_path):
    name = written("scan.ply", ply([[1, 2, 3]]))
    check = ("check", arm, motion, *MOVING)
    refused(2, *check, "--scene", name, says=["--radius: scan.ply is a point cloud, which needs a radius"])
    refused(2, *check, "--scene", written("a.json", '{"obstacles": []}'), "--radius", 1, says=["--radius needs a point cloud"])
    refused(2, *check, "--radius", 1, says=["--radius needs --scene"])
    refused(2, *check, "--scene", name, "--radius=-1", says=["--radius"])
    np.save(tmp_path / "nan.npy", [[0, 0, 0], [0, np.nan, 0]])
    refused(3, *check, "--scene", "nan.npy", "--radius", 1, says=["nan.npy: point 1", "leave such points out"])
    np.save(tmp_path / "wide.npy", np.zeros((2, 4)))
    refused(3, *check, "--scene", "wide.npy", "--radius", 1, says=["wide.npy: has rows of 4 numbers"])
    refused(3, *check, "--scene", name, "--scene", name, "--radius", 1, says=["scan"])
