"""Reach maps: cells beside inverse kinematics, placements, slices."""

import copy
import math
import pickle

import beeline
import numpy as np
import pytest

PUMA, PANDA, RRR = beeline.arms.puma560(), beeline.arms.panda(), beeline.arms.rrr()
COARSE = {"resolution": 0.4, "directions": math.radians(60)}
ARRAYS = ("branches", "manipulability", "margin")


@pytest.fixture(scope="module")
def puma():
    return beeline.reach_map(PUMA, **COARSE)


def assert_equal(a, b):
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))


def margin_of(arm, q):
    middle, half = (arm.upper + arm.lower) / 2, (arm.upper - arm.lower) / 2
    return np.min((1 - abs(q - middle) / half)[..., np.isfinite(half)], axis=-1)


def test_cells_equal_inverse_kinematics(rng):
    map = beeline.reach_map(PUMA, rolls=math.radians(90), **COARSE)
    assert map.branches.shape == map.grid.shape and map.branches.size == map.grid.cells
    reached = np.flatnonzero(map.branches)
    for cell in [*rng.choice(reached, 40), *rng.choice(map.grid.cells, 40)]:
        found = beeline.inverse_kinematics(PUMA, map.grid.pose(int(cell)), all=True)
        q = found.solutions
        if found.singular or (len(q) and margin_of(PUMA, q).min() < 1e-6):
            continue  # infinitely many, or one on a limit
        branches, manipulability, margin = (getattr(map, name).flat[cell] for name in ARRAYS)
        assert branches == len(q)
        if branches == 0:
            assert np.isnan(manipulability) and np.isnan(margin)
        else:
            best = beeline.manipulability(PUMA, q).max()
            assert manipulability == pytest.approx(best, rel=1e-4, abs=1e-6)
            assert margin == pytest.approx(margin_of(PUMA, q).max(), abs=1e-5)


@pytest.mark.parametrize("arm", [PUMA, PANDA], ids=lambda arm: arm.name)
def test_directions_are_reached_with_some_roll(arm, rng):
    map = beeline.reach_map(arm, resolution=0.5, directions=math.radians(90))
    for cell in rng.choice(np.flatnonzero(map.branches), 20):
        turned = map.grid.pose(int(cell))
        rolls = [beeline.RollPitchYaw(yaw=roll) for roll in np.linspace(0, 2 * math.pi, 72)]
        poses = [turned @ beeline.make_pose(np.zeros(3), rpy=roll) for roll in rolls]
        assert beeline.batch_inverse(arm, poses).solved > 0


def test_the_arrays_of_types_and_shapes(puma):
    assert puma.branches.shape == puma.grid.shape == (*(len(c) for c in (puma.grid.x, puma.grid.y, puma.grid.z)), 10)
    assert [getattr(puma, name).dtype for name in ARRAYS] == [np.uint8, np.float32, np.float32]
    assert not any(getattr(puma, name).flags.writeable for name in ARRAYS)
    np.testing.assert_array_equal(np.isnan(puma.margin), puma.branches == 0)


def test_a_range_of_positions(puma):
    all_cells, some = beeline.reach_cells(PUMA, puma.grid), beeline.reach_cells(PUMA, puma.grid, 5, 17)
    assert all_cells and some and some.branches.shape == (12, 10)
    for cells in (all_cells, puma.cells()):
        assert_equal(cells, puma)
    assert_equal(puma.cells(5, 17), some)
    np.testing.assert_array_equal(puma.branches.reshape(-1, 10)[5:17], some.branches)
    assert_equal(puma, beeline.reach_cells(PUMA, puma.grid, threads=1))
    assert beeline.ReachMap(PUMA, puma.grid, all_cells) == puma


def test_positions_summarise_cells(puma):
    best, totals = puma.positions(), puma.totals()
    reached = puma.branches > 0
    np.testing.assert_allclose(best.directions, reached @ puma.grid.fractions, atol=1e-6)
    np.testing.assert_array_equal(best.branches, puma.branches.max(axis=-1))
    np.testing.assert_array_equal(best.margin, np.fmax.reduce(puma.margin, axis=-1))
    assert (totals.cells, totals.reached) == (reached.size, reached.sum())
    assert totals.volume == pytest.approx(totals.reached_positions * 0.4**3)
    assert (totals.positions, totals.reached_positions) == (best.branches.size, (best.branches > 0).sum())
    some = beeline.reach_positions(puma.grid, puma.cells(3, 8))
    np.testing.assert_array_equal(some.manipulability, best.manipulability.ravel()[3:8])


def test_grids_find_their_cells(rng):
    turned = beeline.forward_kinematics(PUMA, PUMA.middle)[:3, :3]
    grids = [
        beeline.ReachGrid(PUMA, **COARSE),
        beeline.ReachGrid(PUMA, rolls=1, **COARSE),
        beeline.ReachGrid(RRR, resolution=2),
        beeline.ReachGrid(PUMA, orientation=turned, lower=[0, -1, 0], upper=[1, 1, 1.5]),
    ]
    assert [grid.orientations for grid in grids] == ["directions", "rolls", "headings", "fixed"]
    for grid in grids:
        assert math.prod(grid.shape) == grid.cells and math.prod(grid.shape[:3]) == grid.positions
        np.testing.assert_allclose(np.linalg.norm(grid.directions, axis=1), 1)
        assert grid.fractions.sum() == pytest.approx(1)
        cells = rng.integers(grid.cells, size=30)
        for cell, pose in zip(cells, grid.pose(cells)):
            assert grid.cell_of(pose) == cell
            p = grid.position_of(pose[:3, 3])
            np.testing.assert_array_equal(grid.centre(p), pose[:3, 3])
            index = np.unravel_index(cell, grid.shape)
            np.testing.assert_array_equal([grid.x[index[0]], grid.y[index[1]], grid.z[index[2]]], pose[:3, 3])
            if grid.orientations in ("directions", "rolls"):
                np.testing.assert_allclose(grid.directions[index[3]], pose[:3, 2], atol=1e-12)
        far = np.eye(4)
        far[0, 3] = 100
        assert grid.cell_of(far) is None and grid.position_of(far[:3, 3]) is None
        assert pickle.loads(pickle.dumps(grid)) == grid == copy.deepcopy(grid)
    np.testing.assert_array_equal(grids[3].orientation, turned)
    assert grids[1].rolls.size == 6 and grids[2].headings.size == 12 and grids[0].rolls is grids[0].headings is None
    assert grids[0] != grids[1]


def test_positions_by_azimuths(rng):
    map = beeline.reach_map(PUMA, azimuths=math.radians(45), **COARSE)
    grid = map.grid
    assert grid.cylindrical and grid.shape[:3] == (len(grid.radius), len(grid.height), len(grid.azimuth))
    assert len(grid.azimuth) == 8
    for name in ("x", "y", "z"):
        with pytest.raises(AttributeError, match="azimuth"):
            getattr(grid, name)
    with pytest.raises(AttributeError, match="x, y and z"):
        print(beeline.ReachGrid(PUMA).azimuth)
    for cell in rng.choice(grid.cells, 30):
        index, pose = np.unravel_index(cell, grid.shape), grid.pose(int(cell))
        azimuth = grid.azimuth[index[2]]
        expected = grid.radius[index[0]] * np.array([math.cos(azimuth), math.sin(azimuth)])
        np.testing.assert_allclose(pose[:3, 3], [*expected, grid.height[index[1]]], atol=1e-12)
        assert grid.cell_of(pose) == cell
    assert pickle.loads(pickle.dumps(grid)) == grid != beeline.ReachGrid(PUMA, **COARSE)
    assert map.positions().directions.shape == grid.shape[:3]


def test_maps_by_sampling(rng):
    map = beeline.reach_map(PUMA, resolution=0.4, any_orientation=True, samples=20_000)
    assert map.grid.orientations == "any" and map.branches.shape == map.grid.shape and len(map.grid.shape) == 3
    assert map.samples == 20_000 and map.totals().reached > 0
    tools = beeline.forward_kinematics(PUMA, rng.uniform(PUMA.lower, PUMA.upper, (200, 6)))
    assert np.mean([map.branches.flat[map.grid.cell_of(tool)] > 0 for tool in tools]) > 0.9
    assert pickle.loads(pickle.dumps(map)) == map


def test_a_planar_arm_has_headings(rng):
    map = beeline.reach_map(RRR, resolution=2)
    for cell in rng.choice(map.grid.cells, 50):
        found = beeline.inverse_kinematics(RRR, map.grid.pose(int(cell)), all=True)
        assert map.branches.flat[cell] == len(found.solutions) or found.singular


def test_budgets(puma):
    ended = beeline.reach_cells(PUMA, puma.grid, max_work=1, threads=1)
    assert not ended and ended.ending == "work_limit"
    for use in (beeline.reach_positions, lambda grid, cells: beeline.ReachMap(PUMA, grid, cells)):
        with pytest.raises(beeline.Error, match="not computed to the end"):
            use(puma.grid, ended)
    with pytest.raises(beeline.Error, match="not computed to the end"):
        beeline.reach_map(PUMA, max_work=1, **COARSE)
    fractions = []
    beeline.reach_map(PUMA, progress=fractions.append, threads=1, **COARSE)
    assert fractions == sorted(fractions) and fractions[-1] == 1

    def fail(fraction):
        raise ArithmeticError("enough")

    with pytest.raises(ArithmeticError, match="enough"):
        beeline.reach_map(PUMA, progress=fail, **COARSE)
    assert not beeline.find_placements(puma, [beeline.forward_kinematics(PUMA, PUMA.middle)], max_work=1)


def test_placements_reach_all_poses(puma, rng):
    mount = np.eye(4)
    mount[:3, 3] = 2, -1, 0
    poses = mount @ beeline.forward_kinematics(PUMA, PUMA.middle + rng.uniform(-0.3, 0.3, (3, 6)))
    found = beeline.find_placements(puma, poses, step=0.2, count=3)
    assert found and found.reason == "" and found.ending == "complete"
    for placement in found.placements:
        there = PUMA.with_mount(placement.world_T_mount)
        np.testing.assert_allclose(beeline.forward_kinematics(there, placement.solutions), poses, atol=1e-6)
        assert not any(there.limit_violations(q) for q in placement.solutions)
        assert placement.margin == pytest.approx(margin_of(PUMA, placement.solutions).min(), abs=1e-9)
        assert placement.duration == 0
    margins = [placement.margin for placement in found.placements]
    assert margins == sorted(margins, reverse=True)
    assert beeline.find_placements(puma, list(poses), step=0.2, count=3, threads=1) == found
    assert pickle.loads(pickle.dumps(found)) == found


def test_placements_from_which_lines_are_possible(puma):
    down = beeline.RollPitchYaw(roll=math.pi)
    poses = [beeline.make_pose(point, rpy=down) for point in ([0.8, -0.3, 0.2], [0.8, 0.3, 0.2], [1, 0, 0.4])]
    found = beeline.find_placements(puma, poses, step=0.2, count=2, lines=True)
    assert found
    for placement in found.placements:
        motion = beeline.move_in_lines(PUMA.with_mount(placement.world_T_mount), None, poses)
        assert motion and placement.duration == pytest.approx(motion.trajectory.times[-1])


def test_no_placement_has_a_reason(puma):
    near, far = np.eye(4), np.eye(4)
    far[0, 3] = 10
    none = beeline.find_placements(puma, [near, far])
    assert not none and none.placements == [] and "farther apart" in none.reason
    one = beeline.find_placements(puma, [near], lower=[5, 0, 0], upper=[5, 0, 0])
    assert not one and one.mounts == 12 and "none of the 12 mounts" in one.reason


def test_slices(puma):
    best = puma.positions()
    for axis, k in (("x", 0), ("y", 1), ("z", 2)):
        for measure in ("directions", *ARRAYS):
            centres = getattr(puma.grid, axis)
            slice = beeline.slice_of(puma, axis, centres[2] + 0.01, measure)
            expected = np.take(getattr(best, measure).astype(np.float32), 2, axis=k)
            expected[np.take(best.branches, 2, axis=k) == 0] = np.nan
            np.testing.assert_array_equal(slice.values, expected)
            assert (slice.measure, slice.normal) == (measure, axis) and slice.at == pytest.approx(centres[2], abs=1e-12)
            for name, coordinates in zip(slice.axes, slice.coordinates):
                np.testing.assert_allclose(coordinates, getattr(puma.grid, name), atol=1e-12)
    assert pickle.loads(pickle.dumps(slice)) == slice and slice.arm == PUMA
    assert "<svg" in slice._repr_svg_() and "largest margin" in beeline.reach_figure(slice).svg


def test_slices_of_a_box_have_two_lengths():
    box = beeline.reach_map(PUMA, lower=[-0.2, -0.6, 0], upper=[0.2, 0.6, 0.8], **COARSE)
    for axis in "xyz":
        slice = beeline.slice_of(box, axis, 0)
        for cells, coordinates in zip(slice.grid, slice.coordinates):
            np.testing.assert_array_equal(coordinates, cells.centres)
        assert slice.values.shape == tuple(map(len, slice.coordinates))


def test_an_image_for_paraview(puma, tmp_path):
    beeline.write_vti(puma, tmp_path / "map.vti")
    assert (tmp_path / "map.vti").read_bytes().startswith(b"<?xml")


def test_maps_are_values(puma):
    for copied in (copy.copy(puma), copy.deepcopy(puma), pickle.loads(pickle.dumps(puma))):
        assert copied == puma
        assert_equal(copied, puma)
    assert puma != beeline.reach_map(PUMA, resolution=0.4, directions=1.5)
    assert repr(puma).startswith("ReachMap(puma560, ") and "10 directions" in repr(puma)
    assert puma.complete and puma.slabs.all() and puma.path == "" and puma.arm == PUMA
    assert (puma.redundant_values, puma.samples) == (16, 0)
    assert beeline.ReachMap(PUMA, puma.grid, puma.cells(), redundant_values=3) != puma
    cells = puma.cells()
    assert pickle.loads(pickle.dumps(cells)) == cells
    own = np.array(cells.branches)
    assert beeline.ReachCells(own, cells.manipulability, margin=cells.margin) == cells and own.flags.writeable


REFUSED = {
    "resolution": lambda: beeline.ReachGrid(PUMA, resolution=0),
    "box": lambda: beeline.ReachGrid(PUMA, lower=[1, 1, 1], upper=[0, 0, 0]),
    "both": lambda: beeline.ReachGrid(PUMA, orientation=np.eye(3), rolls=1),
    "orientation": lambda: beeline.ReachGrid(PUMA, orientation=2 * np.eye(3)),
    "directions": lambda: beeline.ReachGrid(PUMA, directions=math.nan),
    "azimuths": lambda: beeline.ReachGrid(beeline.arms.gantry(), azimuths=1),
    "cell": lambda: beeline.ReachGrid(PUMA).pose(10**9),
    "negative": lambda: beeline.ReachGrid(PUMA).centre(-1),
    "positions": lambda: beeline.reach_cells(PUMA, beeline.ReachGrid(PUMA), 5, 2),
    "too many": lambda: beeline.reach_map(PUMA, resolution=1e-3),
    "redundant_values": lambda: beeline.reach_map(PANDA, redundant_values=0),
    "samples": lambda: beeline.reach_map(beeline.arms.rp(), any_orientation=True, samples=10),
    "threads": lambda: beeline.reach_map(PUMA, threads=-1),
    "joints": lambda: beeline.reach_map(beeline.arms.rp()),
    "another grid": lambda: beeline.reach_positions(beeline.ReachGrid(PUMA), beeline.reach_map(PUMA, **COARSE).cells()),
    "no poses": lambda: beeline.find_placements(beeline.reach_map(PUMA, **COARSE), []),
    "headings": lambda: beeline.find_placements(beeline.reach_map(PUMA, **COARSE), np.eye(4), headings=0),
    "at": lambda: beeline.slice_of(beeline.reach_map(PUMA, **COARSE), "z", 9),
    "axis": lambda: beeline.slice_of(beeline.reach_map(PUMA, **COARSE), "w", 0),
    "shapes": lambda: beeline.ReachCells(np.zeros(3, np.uint8), np.zeros(2, np.float32), np.zeros(3, np.float32)),
}


@pytest.mark.parametrize("call", REFUSED)
def test_refusals_are_one_line(call):
    with pytest.raises(beeline.Error) as refusal:
        REFUSED[call]()
    assert str(refusal.value) and "\n" not in str(refusal.value)


def test_types_that_are_refused(puma):
    cells = puma.cells()
    for wrong in (
        lambda: beeline.ReachGrid("puma560"),
        lambda: beeline.ReachGrid(PUMA, resolutions=1),
        lambda: beeline.ReachCells(cells.branches.astype(int), cells.manipulability, cells.margin),
        lambda: beeline.ReachCells(cells.branches, None, cells.margin),
        lambda: beeline.merge_reach_maps("part.h5", "map.h5"),
        lambda: beeline.find_placements(cells, np.eye(4)),
    ):
        with pytest.raises(TypeError):
            wrong()
