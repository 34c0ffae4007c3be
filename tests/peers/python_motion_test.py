"""The Python module beside ruckig and toppra: motions from point to point, and the fastest retiming along a
spline."""

import logging

import beeline
import numpy as np
import pytest
import ruckig

logging.disable(logging.WARNING)  # toppra reports solvers that it does without
import toppra  # noqa: E402
from toppra.algorithm import TOPPRA  # noqa: E402
from toppra.constraint import JointAccelerationConstraint, JointVelocityConstraint  # noqa: E402

MOTIONS = 2000  # of each number of joints
PATHS = 20
TOLERANCE = 1e-10  # seconds, radians and their rates, relative to the duration where that is above 1 s


@pytest.mark.parametrize("joints", range(1, 8))
def test_motions_from_point_to_point(joints, seed):
    rng = np.random.default_rng([seed, joints])
    differences = []
    for _ in range(MOTIONS):
        velocity, acceleration, jerk = np.exp(rng.uniform(np.log(0.1), np.log(10), (3, joints)))
        start = rng.uniform(-3, 3, joints)
        goal = start + rng.uniform(-3, 3, joints)
        limits = [beeline.Limits(velocity=v, acceleration=a, jerk=j) for v, a, j in zip(velocity, acceleration, jerk)]
        motion = beeline.point_to_point(limits, start, goal)
        asked = ruckig.InputParameter(joints)
        asked.max_velocity, asked.max_acceleration, asked.max_jerk = velocity, acceleration, jerk
        asked.current_position, asked.target_position = start, goal
        peer = ruckig.Trajectory(joints)
        assert ruckig.Ruckig(joints).calculate(asked, peer) in (ruckig.Result.Working, ruckig.Result.Finished)
        # The other joints may be synchronised in several ways; the slowest has one minimum-time motion.
        slowest = int(np.argmax(peer.independent_min_durations))
        alone = [beeline.s_curve(d, own).duration for d, own in zip(goal - start, limits)]
        apart = [abs(motion.duration - peer.duration), np.abs(np.subtract(alone, peer.independent_min_durations)).max()]
        states = motion.sample(motion.duration * np.linspace(0.1, 0.9, 9))
        for k, t in enumerate(np.linspace(0.1, 0.9, 9)):
            theirs = np.array(peer.at_time(peer.duration * t)[:3])[:, slowest]
            ours = [states.position[k, slowest], states.velocity[k, slowest], states.acceleration[k, slowest]]
            apart.append(np.abs(ours - theirs).max())
        differences.append(max(apart) / max(1, motion.duration))
    print(f"{joints} joints, {MOTIONS} motions: largest difference {max(differences):.1e}; BEELINE_SEED={seed}")
    assert max(differences) < TOLERANCE


def test_the_fastest_time_scaling_along_a_spline(seed):
    """On one grid with the same limits. Both are exact at grid points only in the limit: the durations differ by
    1.5e-3 of them with 100 steps, 1.5e-5 with 1,000, 2.4e-6 with 3,000."""
    rng = np.random.default_rng(seed)
    arm = beeline.arms.panda()
    ratios = []
    for _ in range(PATHS):
        waypoints = arm.middle + rng.uniform(-0.5, 0.5, (rng.integers(4, 9), 7))
        s = beeline.chord_length(waypoints)
        path = beeline.refined(beeline.joint_spline(waypoints, s), min_steps=1000, max_change=0.02)
        spline = toppra.SplineInterpolator(s, waypoints)
        assert np.abs(spline(path.s) - path.q).max() < 1e-10 and np.abs(spline(path.s, 1) - path.dq).max() < 1e-10
        assert np.abs(spline(path.s, 2) - path.ddq).max() < 1e-8
        limits = beeline.path_limits(arm)
        scaling = beeline.time_scaling(path, limits, "fastest")
        peer = TOPPRA([JointVelocityConstraint(limits.velocity), JointAccelerationConstraint(limits.acceleration)],
                      spline, gridpoints=path.s, solver_wrapper="seidel")
        speed = peer.compute_parameterization(0, 0)[1]
        duration = np.sum(2 * np.diff(path.s) / (speed[1:] + speed[:-1]))
        ratios.append(scaling.duration / duration)
        retimed = beeline.retime(arm, beeline.Trajectory(arm.joint_names, range(len(waypoints)), waypoints),
                                 profile="fastest", interpolation="cubic")
        assert retimed and retimed.limits.acceleration.fraction <= 1 + 1e-9
    print(f"{PATHS} paths, Beeline's duration by toppra's: {min(ratios):.6f} to {max(ratios):.6f}; BEELINE_SEED={seed}")
    assert 0.999 < min(ratios) and max(ratios) < 1.001
