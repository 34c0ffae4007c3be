"""Reach maps, read by h5py, beside ssik's inverse kinematics at the centres of their cells."""

import importlib
import json
import subprocess

import beeline
import h5py
import numpy as np
import pytest
from catalog_test import ARMS, tool_of, transform
from scipy.spatial.transform import Rotation

SIX_JOINTS = ["puma560", "ur5e", "irb120", "gp8"]
SEVEN_JOINTS = ["iiwa14", "panda"]
LIMIT = 1e-6  # rad: solutions so close to a limit may count or not


@pytest.fixture
def mapped(build, tmp_path):
    """A function that maps an arm and opens the file."""

    def compute(arm, *options):
        path = tmp_path / "map.h5"
        command = [build / "beeline", "reach", "map", arm, "--out", path, *map(str, options)]
        subprocess.run(command, check=True, capture_output=True)
        return h5py.File(path)

    return compute


def rotation(direction, roll):
    """Rz(azimuth) Ry(polar) Rz(roll), whose z axis is the direction."""
    x, y, z = direction
    polar, azimuth = np.arctan2(np.hypot(x, y), z), np.arctan2(y, x)
    return Rotation.from_euler("ZYZ", (azimuth, polar, roll)).as_matrix()


def solutions_of(module, pose, arm, slack):
    """ssik's solutions within the arm's limits widened by `slack`, whole turns aside."""
    lower, upper = (np.array([getattr(limits, end) for limits in arm.limits]) for end in ("lower", "upper"))
    lower, upper = lower - slack, upper + slack
    found = []
    for solution in module.solve(pose, respect_limits=False):
        q = np.asarray(solution.q)
        turns = np.where(np.isfinite(lower), np.ceil((lower - q) / (2 * np.pi)), 0)
        if np.all(q + 2 * np.pi * turns <= upper):
            distances = [np.abs(np.remainder(q - other + np.pi, 2 * np.pi) - np.pi).max() for other in found]
            if min(distances, default=1) > 1e-4:
                found.append(q)
    return found


def cells_with_poses(file, count, generator):
    """(index, pose) of random cells, half of them reached."""
    branches = file["branches"][:]
    for choice in (np.argwhere(branches > 0), np.argwhere(branches == 0)):
        for x, y, z, d, r in generator.permutation(choice)[:count]:
            pose = np.eye(4)
            pose[:3, :3] = rotation(file["directions"][d], file["rolls"][r])
            pose[:3, 3] = file["x"][x], file["y"][y], file["z"][z]
            yield (x, y, z, d, r), pose


@pytest.mark.parametrize("name", SIX_JOINTS)
def test_branches_are_the_solutions_of_another_solver(name, mapped, seed):
    module, frames, _ = ARMS[name]
    solver = importlib.import_module(f"ssik.prebuilt.{module}_ik")
    base, tool = (transform(*frames.get(key, ())) for key in ("base", "tool"))
    arm = beeline.Arm.load(name)
    file = mapped(name, "--resolution", 0.17, "--directions", 45, "--rolls", 50, "--degrees")
    compared = 0
    for index, pose in cells_with_poses(file, 300, np.random.default_rng(seed)):
        there = base @ pose @ tool
        least = len(solutions_of(solver, there, arm, -LIMIT))
        most = len(solutions_of(solver, there, arm, LIMIT))
        assert least <= file["branches"][index] <= max(most, least), (name, index)
        compared += 1
    assert compared == 600


@pytest.mark.parametrize("name", SEVEN_JOINTS)
def test_no_cell_of_a_redundant_arm_is_missed_or_invented(name, mapped, seed):
    module, frames, _ = ARMS[name]
    solver = importlib.import_module(f"ssik.prebuilt.{module}_ik")
    base, tool = (transform(*frames.get(key, ())) for key in ("base", "tool"))
    arm = beeline.Arm.load(name)
    file = mapped(name, "--resolution", 0.3, "--directions", 60, "--rolls", 90, "--degrees")
    for index, pose in cells_with_poses(file, 60, np.random.default_rng(seed)):
        if file["branches"][index] == 0:
            assert not solutions_of(solver, base @ pose @ tool, arm, -LIMIT), (name, index)
            continue
        q = np.asarray(beeline.inverse_kinematics(arm, pose).q)
        assert all(limits.lower <= value <= limits.upper for limits, value in zip(arm.limits, q, strict=True))
        np.testing.assert_allclose(tool_of(solver._KB, q), base @ pose @ tool, atol=1e-7)


def test_what_the_file_says_of_itself(mapped):
    file = mapped("ur5", "--resolution", 0.3, "--directions", 60, "--degrees")
    shape = tuple(len(file[axis]) for axis in ("x", "y", "z", "directions"))
    assert all(file[name].shape == shape for name in ("branches", "manipulability", "margin"))
    assert file["fractions"][:].sum() == pytest.approx(1)
    assert np.array_equal(np.isnan(file["margin"][:]), file["branches"][:] == 0)
    assert json.loads(bytes(file.attrs["arm"]))["name"] == "ur5"
    assert bytes(file.attrs["format"]) == b"beeline reach map" and file.attrs["version"] == 1
    assert file["slabs"][:].all()
