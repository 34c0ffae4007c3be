"""Comparisons of two reach maps: beside numpy's, from their arrays; slices of both, and their picture."""

import copy
import math
import pickle

import beeline
import numpy as np
import pytest

PUMA, RRR = beeline.arms.puma560(), beeline.arms.rrr()
COARSE = {"resolution": 0.4, "directions": math.radians(60)}
ARRAYS = ("branches", "manipulability", "margin")


@pytest.fixture(scope="module")
def puma():
    return beeline.reach_map(PUMA, **COARSE)


@pytest.fixture(scope="module")
def moved():
    mount = beeline.make_pose([0.3, 0, 0.5], rpy=beeline.RollPitchYaw(pitch=0.5))
    return beeline.reach_map(PUMA.with_mount(mount), resolution=0.31, rolls=2, directions=math.radians(45))


def covering_axes(first, second):
    """(lower corner, edge, number) of cells along x, y and z of the finer of two grids, that cover both."""
    axes = []
    for a, b in zip(first.axes, second.axes):
        finer, coarser = (a, b) if a.step <= b.step else (b, a)
        below = max(0, math.ceil((finer.lower - coarser.lower) / finer.step - 1e-9))
        end = lambda axis: axis.lower + axis.cells * axis.step
        above = max(0, math.ceil((end(coarser) - end(finer)) / finer.step - 1e-9))
        axes.append((finer.lower - below * finer.step, finer.step, finer.cells + below + above))
    return axes


def best_at(map, points):
    """The best of all orientations at points: not reached outside the map."""
    cells = [np.floor((p - axis.lower) / axis.step).astype(int) for p, axis in zip(points, map.grid.axes)]
    inside = np.all([(0 <= c) & (c < axis.cells) for c, axis in zip(cells, map.grid.axes)], axis=0)
    cells = [np.where(inside, c, 0) for c in cells]
    branches, manipulability, margin = (getattr(map, name)[tuple(cells)] for name in ARRAYS)
    of_directions = (branches > 0).any(axis=-1) if map.grid.orientations == "rolls" else branches > 0
    orientations = tuple(range(points[0].ndim, branches.ndim))
    best = {
        "directions": of_directions @ map.grid.fractions,
        "branches": branches.max(axis=orientations),
        "manipulability": np.fmax.reduce(manipulability, axis=orientations),
        "margin": np.fmax.reduce(margin, axis=orientations),
    }
    reached = inside & (best["branches"] > 0)
    return reached, {name: np.where(reached, values, np.nan) for name, values in best.items()}


def test_maps_are_compared_where_either_reaches(puma, moved):
    planar = beeline.reach_map(RRR, resolution=2), beeline.reach_map(RRR, resolution=1.3)
    for maps in ((puma, moved), (moved, puma), (puma, puma), planar):
        axes = covering_axes(*(map.grid for map in maps))
        points = np.meshgrid(*(lower + step * (np.arange(n) + 0.5) for lower, step, n in axes), indexing="ij")
        reached, best = zip(*(best_at(map, points) for map in maps))
        step = axes[0][1]
        cell = step ** (2 if maps is planar else 3)
        compared = beeline.compare_reach(*maps)
        assert compared.step == step and compared.both == pytest.approx(np.sum(reached[0] & reached[1]) * cell)
        for k, side in enumerate(compared.sides):
            own, other = (np.nan_to_num(best[i]["directions"]) for i in (k, 1 - k))
            assert side.volume == pytest.approx(reached[k].sum() * cell)
            assert side.volume_only_here == pytest.approx((reached[k] & ~reached[1 - k]).sum() * cell)
            assert side.volume_more_directions == pytest.approx((own > other + 1e-6).sum() * cell)
            assert side.directions == pytest.approx(own[reached[0] | reached[1]].mean())
            for name in ("manipulability", "margin"):
                assert getattr(side, name) == pytest.approx(best[k][name][reached[0] & reached[1]].mean())
        assert pickle.loads(pickle.dumps(compared)) == compared == copy.deepcopy(compared)
        assert repr(compared).startswith("ReachComparison(sides=(ReachSide(volume=")
    assert compared.sides is compared.sides and compared != beeline.compare_reach(puma, moved)


def test_maps_without_common_positions(puma):
    far = PUMA.with_mount(beeline.make_pose([5, 0, 0]))
    compared = beeline.compare_reach(puma, beeline.reach_map(far, **COARSE))
    assert compared.both == 0 and all(side.volume_only_here == side.volume > 0 for side in compared.sides)
    assert all(math.isnan(side.margin) and math.isnan(side.manipulability) for side in compared.sides)
    assert pickle.loads(pickle.dumps(compared)) == compared


def test_slices_of_two_maps_are_at_the_same_cells(puma, moved):
    maps = puma, moved
    axes = covering_axes(puma.grid, moved.grid)
    for axis, k in (("x", 0), ("y", 1), ("z", 2)):
        for measure in ("directions", *ARRAYS):
            lower, step, _ = axes[k]
            at = lower + step * (math.floor((0.3 - lower) / step) + 0.5)
            pair = beeline.slices_of(*maps, axis, 0.3, measure)
            for slice, map in zip(pair, maps):
                assert (slice.measure, slice.normal, slice.arm) == (measure, axis, map.arm)
                assert slice.at == pytest.approx(at, abs=1e-12)
                plane = dict(zip(slice.axes, np.meshgrid(*slice.coordinates, indexing="ij")))
                plane[axis] = np.full(slice.values.shape, at)
                expected = best_at(map, [plane[name] for name in "xyz"])[1][measure]
                np.testing.assert_array_equal(slice.values, expected.astype(np.float32))
            assert pair[0].grid == pair[1].grid
    assert beeline.slices_of(puma, puma, "z", 0.3)[0] == beeline.slice_of(puma, "z", 0.3)


def test_a_picture_of_two_slices(puma, moved):
    pair = beeline.slices_of(puma, moved, "y", 0)
    assert [slice.title for slice in pair] == ["puma560", "puma560"]
    named = [slice.with_title(title) for slice, title in zip(pair, ("floor", "pedestal"))]
    assert [slice.title for slice in named] == ["floor", "pedestal"] and named[0] != pair[0] == named[0].with_title("puma560")
    assert pickle.loads(pickle.dumps(named)) == named and "title='floor'" in repr(named[0])
    picture = beeline.reach_figure(named)
    assert all(text in picture.svg for text in ("floor", "pedestal", "y = 0 m, fraction of the tool directions"))
    assert picture == beeline.reach_figure(tuple(named)) != beeline.reach_figure(pair)
    assert "floor" in named[0]._repr_svg_()


def test_what_is_refused(puma):
    fixed = beeline.reach_map(PUMA, resolution=0.4, orientation=np.eye(3))
    level = beeline.slice_of(puma, "z", 0)
    for call, culprit in (
        (lambda: beeline.compare_reach(puma, fixed), "directions and fixed"),
        (lambda: beeline.slices_of(puma, beeline.reach_map(RRR, resolution=2), "z", 0), "directions and headings"),
        (lambda: beeline.slices_of(puma, puma, "z", 9), "z = 9"),
        (lambda: beeline.slices_of(puma, puma, "w", 0), "axis"),
        (lambda: beeline.reach_figure([level, beeline.slice_of(puma, "z", 0.5)]), "z = 0.4 m"),
        (lambda: beeline.reach_figure([level, beeline.slice_of(puma, "z", 0, "margin")]), "largest margin"),
        (lambda: beeline.reach_figure(3 * [level]), "3 values"),
    ):
        with pytest.raises(beeline.Error, match=culprit) as refusal:
            call()
        assert "\n" not in str(refusal.value)
    for wrong in (
        lambda: beeline.compare_reach(puma, puma.cells()),
        lambda: beeline.reach_figure(puma),
        lambda: beeline.reach_figure([puma, puma]),
        lambda: level.with_title(None),
    ):
        with pytest.raises(TypeError):
            wrong()
