"""Pairs of links that the SRDF files of example-robot-data exempt, and pairs of the matrices of MotionBenchMaker's scenes.

Each pair that `beeline doctor` has collide does so by coal, with hulls of the meshes as Pinocchio reads them; at no random
configuration does coal have a pair collide that is proved never to. With BEELINE_CASES=10 or more: all files, with each of their
tips.
"""

import collections
import json
import os
import subprocess
import tarfile
import warnings
import xml.etree.ElementTree as xml
from pathlib import Path

import coal
import numpy as np
import pytest
from collision_shapes_test import ALL, Peer, values_of_joints
from scipy.spatial import ConvexHull
from urdf_tree import ROBOTS, UrdfTree

import beeline

CONFIGURATIONS = round(20 * float(os.environ.get("BEELINE_CASES", "1")))  # at which proved pairs are looked at
ROBOTS_WITH_SRDF = {  # the URDF files by SRDF file
    "panda_description/srdf/panda": "panda_description/urdf/panda",
    "ur_description/srdf/ur5": "ur_description/urdf/ur5_robot",
    "ur_description/srdf/ur3_gripper": "ur_description/urdf/ur3_gripper",
    "xarm_description/srdf/xarm7": "xarm_description/urdf/xarm7",
}
MORE = {
    "a1_description/srdf/a1": "a1_description/urdf/a1",
    "anymal_b_simple_description/srdf/anymal": "anymal_b_simple_description/robots/anymal",
    "anymal_c_simple_description/srdf/anymal": "anymal_c_simple_description/urdf/anymal",
    "b1_description/srdf/b1": "b1_description/urdf/b1",
    "b1_description/srdf/b1-z1": "b1_description/urdf/b1-z1",
    "baxter_description/srdf/baxter_manipulation": "baxter_description/urdf/baxter",
    "bolt_description/srdf/bolt": "bolt_description/robots/bolt",
    "finger_edu_description/srdf/finger_edu": "finger_edu_description/robots/finger_edu",
    "go1_description/srdf/go1": "go1_description/urdf/go1",
    "go2_description/srdf/go2": "go2_description/urdf/go2",
    "hyq_description/srdf/hyq": "hyq_description/robots/hyq_no_sensors",
    "icub_description/srdf/icub": "icub_description/robots/icub",
    "pr2_description/srdf/pr2": "pr2_description/urdf/pr2",
    "pr2_description/srdf/pr2_manipulation": "pr2_description/urdf/pr2",
    "romeo_description/srdf/romeo_moveit": "romeo_description/urdf/romeo",
    "solo_description/srdf/solo": "solo_description/robots/solo",
    "talos_data/srdf/talos": "talos_data/robots/talos_reduced",
    "ur_description/srdf/ur5_gripper": "ur_description/urdf/ur5_gripper",
    "ur_description/srdf/ur5_joint_limited_robot": "ur_description/urdf/ur5_joint_limited_robot",
}
PROBLEMS = Path(__file__).resolve().parents[3] / "shared/data/motion_bench_maker/panda_problems.tar.xz"


class Bodies:
    """coal's bodies of an arm, with the hulls of Pinocchio's meshes."""

    def __init__(self, path, tip, shapes):
        self.tree, self.peer, self.held = UrdfTree(path), Peer(path), shapes.held
        self.arm = beeline.Arm.load(path, base=self.tree.root, tip=tip)
        self.bodies = [self.convex(one.geometry) for one in self.peer.shapes.geometryObjects]

    @staticmethod
    def convex(geometry):
        if not hasattr(geometry, "num_tris"):
            return geometry
        hull = ConvexHull(np.array(geometry.vertices()))
        points, triangles = coal.StdVec_Vec3s(), coal.StdVec_Triangle()
        number = {vertex: i for i, vertex in enumerate(hull.vertices)}
        points.extend(list(hull.points[hull.vertices]))
        triangles.extend([coal.Triangle(*(number[i] for i in face)) for face in hull.simplices])
        return coal.Convex(points, triangles)

    def depth(self, names, q):
        """How deep two links are in each other; below 0: their distance."""
        poses = self.peer.poses(values_of_joints(self.tree, self.arm, self.held, q))
        deepest = -np.inf
        for i in self.peer.names[names[0]]:
            for k in self.peer.names[names[1]]:
                at = [coal.Transform3s(poses[n][:3, :3], poses[n][:3, 3]) for n in (i, k)]
                distance = coal.distance(self.bodies[i], at[0], self.bodies[k], at[1], coal.DistanceRequest(),
                                         coal.DistanceResult())
                deepest = max(deepest, -distance)
        return deepest


def reasons_of(path):
    pairs = xml.parse(path).getroot().iter("disable_collisions")
    return {frozenset((pair.get("link1"), pair.get("link2"))): pair.get("reason", "none") for pair in pairs}


Found = collections.namedtuple("Found", "names status q depth")


def doctor(build, path, tree, tip, *options):
    """What the command finds of each pair."""
    command = [build / "beeline", "doctor", path, "--base", tree.root, "--tip", tip, *options, "--json"]
    answer = subprocess.run(command, capture_output=True, text=True)
    assert answer.returncode in (0, 1) and answer.stdout, answer.stderr
    pairs = json.loads(answer.stdout).get("exemptions", [])
    return [Found(tuple(one["bodies"]), one["status"], np.array(one.get("q", [])), one.get("depth")) for one in pairs]


def assert_confirmed(found, bodies, rng):
    """Returns the least depth by coal. Its depth of a cylinder may be larger than the least translation that separates."""
    least = np.inf
    q = rng.uniform(np.maximum(bodies.arm.lower, -np.pi), np.minimum(bodies.arm.upper, np.pi), (CONFIGURATIONS, bodies.arm.dof))
    for one in found:
        if one.status in ("collides", "always_collides"):
            depth = bodies.depth(one.names, one.q)
            assert depth > 0, f"coal has {one.names} {-depth} m apart at {one.q}"
            least = min(least, depth)
        if one.status == "never_close":
            for row in q:
                assert bodies.depth(one.names, row) < 0, f"{one.names} collide at {row}"
    return least


@pytest.mark.parametrize("name", ROBOTS_WITH_SRDF | (MORE if ALL else {}))
def test_pairs_of_srdf_files(name, build, seed):
    print(f"BEELINE_SEED={seed}")
    rng = np.random.default_rng(seed)
    srdf, path = ROBOTS / f"{name}.srdf", ROBOTS / f"{(ROBOTS_WITH_SRDF | MORE)[name]}.urdf"
    tree, reasons, counts, least = UrdfTree(path), reasons_of(srdf), {}, np.inf
    tips = sorted(tree.leaves(), key=lambda tip: -len(tree.moving_joints(tip)))
    for tip in [tip for tip in tips if tree.moving_joints(tip)]:
        if counts and not ALL:
            break
        try:
            shapes = beeline.read_arm_shapes(path, base=tree.root, tip=tip, srdf=srdf)
        except beeline.FileError as error:
            if name in ROBOTS_WITH_SRDF:
                assert "moves with it" in str(error), error
            print(tip, error)
            continue
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", beeline.ModelWarning)
            bodies = Bodies(path, tip, shapes)
        found = doctor(build, path, tree, tip, "--srdf", srdf)
        assert [one.names for one in found] == [tuple(pair) for pair in shapes.allowed_pairs]
        least = min(least, assert_confirmed(found, bodies, rng))
        for one in found:  # of several tips, the strongest statement on each pair
            strength = ["not_checked", "never_close", "no_collision", "always_collides", "collides"]
            pair = frozenset(one.names)
            if strength.index(one.status) >= strength.index(counts.get(pair, "not_checked")):
                counts[pair] = one.status
    table = collections.Counter((status, reasons.get(pair, "none")) for pair, status in counts.items())
    print(f"{name}: {len(counts)} pairs, those that collide at least {least:.1e} m deep by coal")
    for (status, reason), number in sorted(table.items()):
        print(f"  {status:16} {reason:10} {number}")
    assert counts or name not in ROBOTS_WITH_SRDF


@pytest.mark.skipif(not PROBLEMS.is_file(), reason="the problems of MotionBenchMaker are not at hand")
def test_matrices_of_motion_bench_maker(build, tmp_path, seed):
    print(f"BEELINE_SEED={seed}")
    rng = np.random.default_rng(seed)
    path, tip = ROBOTS / "panda_description/urdf/panda.urdf", "panda_hand_tcp"
    bodies = Bodies(path, tip, beeline.read_arm_shapes(path, tip=tip))
    links, found = set(bodies.peer.names), {}
    with tarfile.open(PROBLEMS) as tar:
        names = sorted(name for name in tar.getnames() if Path(name).name.startswith("scene"))
        for name in names if ALL else names[::100]:
            (tmp_path / "scene.yaml").write_bytes(tar.extractfile(name).read())
            for one in doctor(build, path, bodies.tree, tip, "--scene", tmp_path / "scene.yaml"):
                found[name, one.names] = one
    of_links = {one.names: one for one in found.values() if set(one.names) <= links}  # the same in all scenes
    least = assert_confirmed(of_links.values(), bodies, rng)
    scenes = len({name for name, _ in found})
    for what, pairs in (("pairs of two links", of_links), ("pairs with obstacles", {k: v for k, v in found.items() if v.names not in of_links})):
        print(f"{scenes} scenes, {what}: {dict(collections.Counter(one.status for one in pairs.values()))}")
    print([one.names for one in of_links.values() if one.status == "collides"], f"at least {least:.1e} m deep by coal")
    assert any(one.status == "collides" for one in of_links.values())
