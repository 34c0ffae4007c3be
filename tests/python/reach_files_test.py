"""Files of reach maps: what is computed in memory, parts, threads, damage; refused in a build without HDF5."""

import math
import pickle
import subprocess
import sys
import textwrap
import threading

import beeline
import numpy as np
import pytest

PUMA = beeline.arms.puma560()
COARSE = {"resolution": 0.4, "directions": math.radians(60)}
ARRAYS = ("branches", "manipulability", "margin")


def has_hdf5():
    try:
        beeline.ReachMap.load("no such file")
    except beeline.Error as error:
        return "without HDF5" not in str(error)


needs_hdf5 = pytest.mark.skipif(not has_hdf5(), reason="needs a build with HDF5")


@pytest.fixture(scope="module")
def puma():
    return beeline.reach_map(PUMA, **COARSE)


def assert_equal(a, b):
    for name in ARRAYS:
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))


@needs_hdf5
def test_files_hold_what_is_computed_in_memory(puma, tmp_path):
    path = tmp_path / "puma.h5"
    assert beeline.compute_reach_map(PUMA, puma.grid, path) == "complete"
    read = beeline.ReachMap.load(path)
    assert_equal(read, puma)
    assert read == puma == pickle.loads(pickle.dumps(read)) and read.path == str(path)
    assert read.totals() == puma.totals() and read.positions() == puma.positions()
    pose = [beeline.forward_kinematics(PUMA, PUMA.middle)]
    assert beeline.find_placements(read, pose) == beeline.find_placements(puma, pose)
    turned = beeline.ReachGrid(PUMA, azimuths=1, **COARSE)
    assert beeline.compute_reach_map(PUMA, turned, path) == "complete"
    assert_equal(beeline.ReachMap.load(path), beeline.reach_cells(PUMA, turned))


@needs_hdf5
def test_shards_are_joined(tmp_path):
    grid = beeline.ReachGrid(PUMA, resolution=0.09, directions=math.radians(60))
    parts = [tmp_path / "one.h5", tmp_path / "two.h5"]
    for number, part in enumerate(parts, 1):
        assert beeline.compute_reach_map(PUMA, grid, part, shard=(number, 2)) == "complete"
    half = beeline.ReachMap.load(parts[0])
    assert not half.complete and 0 < half.slabs.sum() < half.slabs.size and "incomplete" in repr(half)
    assert half.totals().cells < grid.cells
    uses = [lambda: half.branches, lambda: beeline.compare_reach(half, half), lambda: beeline.slice_of(half, "z", 0)]
    for use in (half.cells, half.positions, *uses):
        with pytest.raises(beeline.Error):
            use()
    assert half == beeline.ReachMap.load(parts[0])
    with pytest.raises(beeline.Error, match="lack"):
        beeline.merge_reach_maps(parts[:1], tmp_path / "all.h5")
    beeline.merge_reach_maps(parts, tmp_path / "all.h5")
    assert_equal(beeline.ReachMap.load(tmp_path / "all.h5"), beeline.reach_cells(PUMA, grid))
    with pytest.raises(beeline.Error, match="shard"):
        beeline.compute_reach_map(PUMA, grid, tmp_path / "third.h5", shard=(3, 2))


@needs_hdf5
def test_a_computation_that_was_ended_goes_on(puma, tmp_path):
    path = tmp_path / "puma.h5"
    assert beeline.compute_reach_map(PUMA, puma.grid, path, max_work=1) == "work_limit" and not path.exists()
    assert beeline.compute_reach_map(PUMA, puma.grid, path) == "complete"
    assert beeline.ReachMap.load(path) == puma


@needs_hdf5
def test_threads_read_files_at_once(puma, tmp_path):
    beeline.compute_reach_map(PUMA, puma.grid, tmp_path / "puma.h5")
    shared, equal = beeline.ReachMap.load(tmp_path / "puma.h5"), []

    def read():
        for _ in range(20):
            own = beeline.ReachMap.load(tmp_path / "puma.h5")
            equal.append(own.cells() == shared.cells() and own.totals() == shared.totals())

    threads = [threading.Thread(target=read) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(equal) == 80 and all(equal)


@needs_hdf5
def test_damaged_files_are_refused(puma, tmp_path, seed):
    """In a process of its own, as its end would end the tests."""
    path = tmp_path / "puma.h5"
    beeline.compute_reach_map(PUMA, puma.grid, path)
    program = f"""
    import os, random, beeline
    whole, refused = open({str(path)!r}, "rb").read(), 0
    random.seed({seed})
    for i in range(300):
        damaged = bytearray(whole[: random.randrange(len(whole))] if i % 3 == 0 else whole)
        for _ in range(random.choice([1, 4, 30])):
            if damaged:
                damaged[random.randrange(len(damaged))] = random.randrange(256)
        open("new.h5", "wb").write(damaged)
        os.replace("new.h5", "damaged.h5")  # HDF5 knows the contents of a file that is open
        try:
            map = beeline.ReachMap.load("damaged.h5")
            map.totals(), map.branches, map.positions()
        except beeline.Error as error:
            assert "\\n" not in str(error)
            refused += 1
    print(refused)
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], cwd=tmp_path, capture_output=True,
                          text=True, timeout=120)  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) > 200


@pytest.mark.skipif(has_hdf5(), reason="needs a build without HDF5")
def test_without_hdf5_files_are_refused(puma, tmp_path):
    for use in (
        lambda: beeline.ReachMap.load(tmp_path / "map.h5"),
        lambda: beeline.compute_reach_map(PUMA, puma.grid, tmp_path / "map.h5"),
        lambda: beeline.merge_reach_maps([tmp_path / "map.h5"], tmp_path / "all.h5"),
    ):
        with pytest.raises(beeline.Error, match="h5py.*BEELINE_HDF5=ON"):
            use()
