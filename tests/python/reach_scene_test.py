"""Reach maps and placements in a scene: the option blocked_by."""

import copy
import math
import pickle

import beeline
import numpy as np
import pytest

UR5 = beeline.arms.ur5()
GRID = {"resolution": 0.4, "directions": math.radians(90), "rolls": math.radians(90)}
LINKS = [beeline.LinkShapes(f"link{i}", i, [beeline.Shape(beeline.Sphere(0.03))]) for i in range(1, 7)]


def model_with_box(place, size, arm=UR5, **options):
    pose = np.eye(4)
    pose[:3, 3] = place
    scene = beeline.Scene([beeline.Obstacle("box", [beeline.Shape(beeline.Box(np.full(3, size)), pose)])])
    return beeline.CollisionModel(arm, LINKS, scene, self_collision=False, **options)


def test_cells_count_free_solutions(rng):
    model = model_with_box([0.4, 0, 0.3], 0.4, clearance=0.02)
    assert model.clearance == 0.02 and len(model.digest) == 16
    alone, free = beeline.reach_map(UR5, **GRID), beeline.reach_map(UR5, blocked_by=model, **GRID)
    assert np.all(free.branches <= alone.branches) and 0 < (free.branches > 0).sum() < (alone.branches > 0).sum()
    for cell in rng.choice(np.flatnonzero(alone.branches), 30):
        found = beeline.inverse_kinematics(UR5, free.grid.pose(int(cell)), all=True, blocked_by=model)
        if not found.self_motion_dimension:
            assert free.branches.flat[cell] == len(found.solutions)
    assert free.scene == beeline.ReachScene(model.digest, clearance=0.02) and alone.scene is None
    for again in (pickle.loads(pickle.dumps(free)), copy.copy(free)):
        assert again == free and again.scene == free.scene
    far = beeline.reach_map(UR5, blocked_by=model_with_box([5, 0, 0], 1), **GRID)
    np.testing.assert_array_equal(far.branches, alone.branches)
    assert far != alone, "another scene is another map"


def test_what_a_scene_does_not_have():
    model = model_with_box([0.4, 0, 0.3], 0.4)
    with pytest.raises(beeline.Error, match="rolls"):
        beeline.reach_map(UR5, resolution=0.4, blocked_by=model)
    with pytest.raises(beeline.Error, match="azimuths"):
        beeline.reach_map(UR5, resolution=0.4, azimuths=1, rolls=1, blocked_by=model)
    with pytest.raises(beeline.Error, match="another arm"):
        beeline.reach_map(beeline.arms.ur5e(), blocked_by=model, **GRID)
    with pytest.raises(TypeError, match="blocked_by"):
        beeline.reach_map(UR5, blocked_by=[model], **GRID)
    with pytest.raises(beeline.Error, match="without a scene"):
        beeline.find_placements(beeline.reach_map(UR5, blocked_by=model, **GRID), [np.eye(4)])


def test_the_base_must_not_stand_in_an_obstacle():
    base = beeline.LinkShapes("base", 0, [beeline.Shape(beeline.Sphere(0.1))])
    box = np.eye(4)
    box[:3, 3] = [0, 0, 0.3]
    scene = beeline.Scene([beeline.Obstacle("box", [beeline.Shape(beeline.Box([1, 1, 0.3]), box)])])
    model = beeline.CollisionModel(UR5, [base, *LINKS], scene)
    assert not beeline.base_blocked_by(model), "0.05 m apart"
    up = np.eye(4)
    up[2, 3] = 0.1
    reason = beeline.base_blocked_by(model.with_mount(up))
    assert reason.code == "bodies_collide" and (reason.fields["body"], reason.fields["other_body"]) == ("base", "box")


def test_placements_are_free_where_the_arm_stands():
    map = beeline.reach_map(UR5, resolution=0.3, directions=math.radians(90))
    q = np.array([0.2, -1.2, 1.6, -1.9, -1.5, 0.3])
    poses = [beeline.forward_kinematics(UR5, q), beeline.forward_kinematics(UR5, -q)]
    model = model_with_box([0, 0.2, 0.2], 0.3)
    options = {"lower": [-0.4, -0.4, 0], "upper": [0.4, 0.4, 0], "headings": 2, "count": 1000}
    alone, found = beeline.find_placements(map, poses, **options), beeline.find_placements(map, poses, blocked_by=model, **options)
    assert found.reaching == alone.reaching > found.blocked > 0 and found.blocked_reason.code.startswith("bodies_")
    assert found.placements
    for placement in found.placements:
        there = model.with_mount(placement.world_T_mount)
        made = model_with_box([0, 0.2, 0.2], 0.3, UR5.with_mount(placement.world_T_mount))
        assert there.arm == made.arm
        for q in placement.solutions:
            assert not beeline.blocked_by(made, q) and not beeline.blocked_by(there, q)
    full = model_with_box([0, 0, 0], 100)
    none = beeline.find_placements(map, poses, blocked_by=full, **options)
    assert not none and none.blocked == none.reaching and none.reason.code == "no_mount_reaches"
    assert none.reason.details[0] == none.blocked_reason
    with pytest.raises(beeline.Error, match="another arm"):
        beeline.find_placements(map, poses, blocked_by=model_with_box([1, 0, 0], 0.1, beeline.arms.ur5e()))
