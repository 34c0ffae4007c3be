"""The command for ARM, under qemu, beside the one of this machine: the same rows, statuses, solutions and numbers."""

import json
import os
import shlex
import subprocess

import numpy as np
import pytest

EMULATOR = shlex.split(os.environ["BEELINE_EMULATOR"])
NATIVE = os.environ["BEELINE_NATIVE"]
TOLERANCE = 1e-10  # of inverse kinematics, by default
ROWS = 30  # of each kind of pose
ARMS = [arm["name"] for arm in json.loads(subprocess.check_output([NATIVE, "arms", "--json"]))["arms"]]


def numbers(values):
    return ",".join(map(repr, map(float, values)))


@pytest.fixture
def both(build, tmp_path):
    """both(*arguments) -> the JSON documents of the native command and of that for ARM; {} is native or arm."""

    def run(*arguments):
        commands = {"native": [NATIVE], "arm": [*EMULATOR, str(build / "beeline")]}
        documents = []
        for machine, command in commands.items():
            command = command + [str(part).replace("{}", machine) for part in arguments] + ["--json"]
            process = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
            assert process.returncode in (0, 1), process.stderr
            documents.append(json.loads(process.stdout))
        return documents

    return run


@pytest.fixture
def rows(both, tmp_path):
    """rows(kind, arm, file, ...) -> the rows that `batch` writes on both machines."""

    def run(kind, arm, name, *options):
        both("batch", kind, arm, "--in", name, "--out", "{}.npy", *options)
        return np.load(tmp_path / "native.npy"), np.load(tmp_path / "arm.npy")

    return run


@pytest.fixture
def q(both, tmp_path, seed):
    """q(arm) -> random configurations within the limits, or within half a turn or metre; also in q.npy."""

    def make(arm):
        joints = both("show", arm)[0]["joints"]
        lower, upper = (
            [side if joint["limits"][key] is None else joint["limits"][key] for joint in joints]
            for key, side in (("lower", -3.0), ("upper", 3.0))
        )
        values = np.random.default_rng(seed).uniform(lower, upper, (ROWS, len(joints)))
        np.save(tmp_path / "q.npy", values)
        return values

    return make


@pytest.mark.parametrize("arm", ARMS)
def test_forward_kinematics_and_jacobians(both, rows, q, arm):
    configurations = q(arm)
    for kind in "fk", "jacobian":
        native, other = rows(kind, arm, "q.npy")
        np.testing.assert_allclose(other, native, rtol=0, atol=1e-13 * max(1, np.abs(native).max()))
    given = "--q=" + numbers(configurations[0].tolist())
    native, other = both("fk", arm, given)
    np.testing.assert_allclose(other["pose"]["matrix"], native["pose"]["matrix"], atol=1e-13)
    native, other = both("jacobian", arm, given)
    np.testing.assert_allclose(other["jacobian"], native["jacobian"], atol=1e-13)


@pytest.mark.parametrize("arm", ARMS)
def test_inverse_kinematics(both, rows, q, tmp_path, seed, arm):
    q(arm)
    reached, _ = rows("fk", arm, "q.npy", "--layout", "pose")
    random = np.random.default_rng(seed)
    moved = reached.copy()  # many of these are out of reach or have solutions outside the limits alone
    translation = 2 if both("show", arm)[0]["planar"] else 3
    moved[:, :translation] += random.uniform(-1, 1, (ROWS, translation)) * np.abs(reached).max()
    poses = np.vstack([reached, moved])
    np.save(tmp_path / "poses.npy", poses)

    native, other = rows("ik", arm, "poses.npy", "--status")
    different = np.flatnonzero(native[:, -2] != other[:, -2])
    assert different.size == 0, [(poses[i].tolist(), native[i, -2], other[i, -2]) for i in different]
    solved = other[:, -2] == 0
    assert solved.any()
    assert (other[solved, -1] <= TOLERANCE).all()

    for pose in poses[[0, 1, 2, ROWS, ROWS + 1]]:
        native, other = both("ik", arm, "--pose=" + numbers(pose.tolist()), "--all")
        assert other["status"] == native["status"], pose.tolist()
        assert len(other["solutions"]) == len(native["solutions"]), pose.tolist()
        assert other["complete"] == native["complete"], pose.tolist()
        if other["status"] == "solved":
            assert other["residual"] <= TOLERANCE
