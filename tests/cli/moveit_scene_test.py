"""--scene with the files of MoveIt: .scene, and PlanningScene as YAML and JSON."""

import json
import pathlib
import tarfile

import pytest

from scene_test import MOVING, check

DATA = pathlib.Path(__file__).resolve().parents[3] / "shared/data/motion_bench_maker"

CELL = """name: cell
allowed_collision_matrix:
  entry_names: [link1, link3, finger]
  entry_values: [[false, true, true], [true, false, true], [true, true, false]]
world:
  collision_objects:
    - id: post
      header: {frame_id: FRAME}
      primitives: [{type: sphere, dimensions: [0.1]}]
      primitive_poses: [{position: [9, 0, 0], orientation: [0, 0, 0, 1]}]
"""
URDF = """<robot name="r"><link name="stand"/><link name="foot"/>
<link name="arm"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
<joint name="plate" type="fixed"><parent link="stand"/><child link="foot"/><origin xyz="0 0 1"/></joint>
<joint name="j" type="revolute"><parent link="foot"/><child link="arm"/><limit lower="-3" upper="3" velocity="1"/></joint></robot>"""


def test_all_forms_are_the_same_scene(beeline, arm, motion, written):
    text = "cell\n* post\n0 0 0\n0 0 0 1\n1\nsphere\n0.1\n9 0 0\n0 0 0 1\n0 0 0 0\n0\n.\n"
    ours = json.dumps({"obstacles": [{"name": "post", "shapes": [{"sphere": {"radius": 0.1}, "pose": {"xyz": [9, 0, 0]}}]}],
                       "exempted_pairs": [["link1", "link3"], ["finger", "link1"]]})
    message = {"world": {"collision_objects": [{
        "id": "post", "primitives": [{"type": 2, "dimensions": [0.1]}],
        "primitive_poses": [{"position": {"x": 9, "y": 0, "z": 0}, "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}]}]}}
    files = [written("a.scene", text), written("b.json", json.dumps(message)), written("c.yaml", CELL.replace("FRAME", "world")),
             written("d.json", ours)]
    proofs = [check(beeline, arm, motion, "--scene", file)["clearance"] for file in files]
    assert proofs[0]["status"] == "clear"
    alone = [check(beeline, arm, motion, "--scene", file, "--no-self")["clearance"] for file in files]
    assert {(proof["status"], proof["least_distance"], proof["time"]) for proof in alone} == {
        ("clear", alone[0]["least_distance"], alone[0]["time"])}
    # Of the matrix only the pair of this arm counts; the report lists it.
    assert [proof["exempted_pairs"] for proof in proofs] == [[], [], [["link1", "link3"]], [["link1", "link3"]]]
    assert proofs[2]["pairs"] + proofs[2]["apart_pairs"] < proofs[0]["pairs"] + proofs[0]["apart_pairs"]
    report = beeline("check", arm, motion, *MOVING, "--scene", files[2]).out
    assert "may touch     by the scene's matrix: link1 and link3\n" in report


def test_frames_are_links_of_the_base(beeline, written):
    """The mount moves the arm, and what is in the frame of its base."""
    arm = written("arm.urdf", URDF)
    motion = written("motion.csv", "t,j\n0,0\n1,0.1\n")
    for frame, height in ("stand", 0), ("foot", 1):
        scene = written("cell.yaml", CELL.replace("FRAME", frame))
        for mount in (), ("--mount", "100,0,0"):
            distance = check(beeline, arm, motion, "--scene", scene, *mount)["clearance"]["upper"]
            assert distance == pytest.approx((81 + (1 - height) ** 2) ** 0.5 - 0.2, abs=1e-6)
    answer = beeline("check", arm, motion, *MOVING, "--scene", written("arm.yaml", CELL.replace("FRAME", "arm")))
    assert answer.code == 3 and answer.err.count("\n") == 1
    assert 'is in the frame "arm", whose pose in the world is not known; known frames: foot, stand, world' in answer.err


@pytest.mark.skipif(not DATA.exists(), reason="the problems of MotionBenchMaker are not here")
def test_problems_of_motion_bench_maker(beeline, written, tmp_path):
    """Scenes of boxes and cylinders, and a matrix that exempts a pair two links apart."""
    with tarfile.open(DATA / "panda_problems.tar.xz") as archive:
        for kind in "bookshelf_small", "cage", "table_pick":
            archive.extract(f"{kind}_panda/scene0001.yaml", tmp_path)
    panda = str(DATA / "panda_spherized.urdf")
    q = "0,-0.785,0,-2.356,0,1.571,0.785"
    for kind in "bookshelf_small", "cage", "table_pick":
        scene = str(tmp_path / f"{kind}_panda/scene0001.yaml")
        motion = written("still.csv", "t," + ",".join(f"panda_joint{i}" for i in range(1, 8)) + f"\n0,{q}\n1,{q}\n")
        proof = check(beeline, panda, motion, "--scene", scene, "--tip", "panda_hand")["clearance"]
        assert len(proof["obstacles"]) > 3 and ["panda_link3", "panda_link7"] in proof["exempted_pairs"]
