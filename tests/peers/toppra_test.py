"""Beeline's fastest law beside toppra, the authors' own implementation of TOPP-RA: along the same
spline, with the same limits, never slower by more than their grids account for."""

import json
import logging
import subprocess

import numpy
import pytest
from random_cases import cases

logging.disable(logging.WARNING)  # toppra tells about solvers that it does without
import toppra  # noqa: E402
from toppra.algorithm import TOPPRA  # noqa: E402
from toppra.constraint import JointAccelerationConstraint, JointVelocityConstraint  # noqa: E402

CASES = cases(150)
LIMITS = {  # of velocity and acceleration, joint by joint
    "panda": ([2.175] * 4 + [2.61] * 3, [15, 7.5, 10, 12.5, 15, 20, 20]),
    "ur5": ([3.14] * 7, [4.0] * 7),
}


def arm_file(path, velocity, acceleration):
    joints = [
        {"name": f"j{i}", "type": "revolute",
         "limits": {"velocity": float(v), "acceleration": float(a)}}
        for i, (v, a) in enumerate(zip(velocity, acceleration))
    ]
    path.write_text(json.dumps({"name": "random", "joints": joints}))


@pytest.mark.parametrize("like", LIMITS)
def test_no_slower_than_toppra_along_the_same_spline(like, build, tmp_path, seed):
    random = numpy.random.default_rng(seed)
    ratios = []
    for _ in range(CASES):
        joints, count = random.integers(1, 8), random.integers(3, 11)
        waypoints = random.uniform(-1.5, 1.5, (count, joints))
        velocity, acceleration = (numpy.array(all_of[:joints], float) for all_of in LIMITS[like])
        chords = numpy.linalg.norm(numpy.diff(waypoints, axis=0), axis=1)
        parameter = numpy.concatenate([[0], numpy.cumsum(chords)])
        spline = toppra.SplineInterpolator(parameter, waypoints)
        peer = TOPPRA(
            [JointVelocityConstraint(velocity), JointAccelerationConstraint(acceleration)],
            spline, solver_wrapper="seidel")
        speed, s = peer.compute_parameterization(0, 0)[1], peer.gridpoints
        duration = numpy.sum(2 * numpy.diff(s) / (speed[1:] + speed[:-1]))

        arm_file(tmp_path / "arm.json", velocity, acceleration)
        rows = [",".join(f"j{i}" for i in range(joints))]
        rows += [",".join(map(repr, map(float, q))) for q in waypoints]
        (tmp_path / "waypoints.csv").write_text("\n".join(rows) + "\n")
        command = [build / "beeline", "retime", "arm.json", "waypoints.csv", "--profile", "fastest",
                   "--json"]
        answer = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
        assert answer.returncode == 0, answer.stderr
        report = json.loads(answer.stdout)
        assert report["limits"]["velocity"]["fraction"] <= 1 + 1e-9
        assert report["limits"]["acceleration"]["fraction"] <= 1 + 1e-9
        ratios.append(report["duration"] / duration)
    print(f"{like}: {CASES} paths, Beeline's duration by toppra's: {min(ratios):.4f} to "
          f"{max(ratios):.4f}, median {numpy.median(ratios):.4f}; BEELINE_SEED={seed}")
    assert max(ratios) < 1.01
