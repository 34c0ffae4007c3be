"""Motions from rest to rest as quick as Ruckig's: random ones of one to seven joints, 100,000 in a thorough run, some without
limits on acceleration and jerk."""

import subprocess

import numpy as np
import pytest
import ruckig
from random_cases import cases

MOTIONS = {joints: cases(14_286) for joints in range(1, 8)}
TOLERANCE = 1e-6  # seconds, or relative where a motion takes longer than one


def random_motions(joints, seed):
    """An array motions x (velocity, acceleration, jerk, from, to) x joints."""
    random = np.random.default_rng([seed, joints])
    count = MOTIONS[joints]
    limits = np.exp(random.uniform(np.log(0.1), np.log(10), (count, 3, joints)))
    # None on jerk now and then, and then now and then none on acceleration: Ruckig's three orders.
    no_jerk = random.random((count, joints)) < 0.2
    no_acceleration = no_jerk & (random.random((count, joints)) < 0.3)
    limits[:, 2][no_jerk] = np.inf
    limits[:, 1][no_acceleration] = np.inf
    start = random.uniform(-3, 3, (count, joints))
    way = random.uniform(-3, 3, (count, joints))
    way *= np.where(random.random((count, joints)) < 0.3, 1e-3, 1)
    way *= random.random((count, joints)) < 0.9
    return np.concatenate([limits, np.stack([start, start + way], axis=1)], axis=1)


def beeline_answers(build, motions):
    joints = motions.shape[2]
    program = build / "tests" / "motion_stream"
    answer = subprocess.run([program, str(joints)], input=motions.tobytes(), capture_output=True)
    assert answer.returncode == 0, answer.stderr.decode()
    numbers = np.frombuffer(answer.stdout).reshape(len(motions), 2 + joints + 9 * 3 * joints)
    durations, alone, states = np.split(numbers, [2, 2 + joints], axis=1)
    return durations, alone, states.reshape(-1, 9, 3, joints)


def ruckig_trajectory(velocity, acceleration, jerk, start, goal, synchronization):
    joints = len(start)
    asked = ruckig.InputParameter(joints)
    asked.max_velocity, asked.max_acceleration, asked.max_jerk = velocity, acceleration, jerk
    asked.current_position, asked.target_position = start, goal
    asked.synchronization = synchronization
    trajectory = ruckig.Trajectory(joints)
    result = ruckig.Ruckig(joints).calculate(asked, trajectory)
    assert result in (ruckig.Result.Working, ruckig.Result.Finished), result
    return trajectory


def assert_close(ours, theirs, size):
    assert np.all(np.abs(np.subtract(ours, theirs)) <= TOLERANCE * np.maximum(1, size))


@pytest.mark.parametrize("joints", MOTIONS)
def test_synchronised_by_time(joints, build, seed):
    motions = random_motions(joints, seed)
    durations, alone, states = beeline_answers(build, motions)
    for motion, (duration, _), own, samples in zip(motions, durations, alone, states):
        peer = ruckig_trajectory(*motion, ruckig.Synchronization.Time)
        assert_close(duration, peer.duration, duration)
        assert_close(own, peer.independent_min_durations, own)
        # The slowest joint has no choice: one motion is the quickest. Without a limit on
        # acceleration its velocity jumps, and without one on jerk its acceleration.
        slowest = int(np.argmax(own))
        compared = 3 - int(np.isinf(motion[2, slowest]))
        for tenth, sample in enumerate(samples, 1):
            theirs = np.array(peer.at_time(peer.duration * tenth / 10)[:compared])
            assert_close(sample[:compared, slowest], theirs[:, slowest], duration)


@pytest.mark.parametrize("joints", MOTIONS)
def test_straight(joints, build, seed):
    """As one joint that goes from 0 to 1 in Ruckig, with each joint's limits over its way."""
    motions = random_motions(joints, seed + 1)
    durations, _, _ = beeline_answers(build, motions)
    for motion, (by_time, straight) in zip(motions, durations):
        way = np.abs(motion[4] - motion[3])
        if not way.any():
            assert straight == 0
            continue
        limits = [[min(limit[way > 0] / way[way > 0])] for limit in motion[:3]]
        peer = ruckig_trajectory(*limits, [0], [1], ruckig.Synchronization.Time)
        assert_close(straight, peer.duration, straight)
        assert straight >= by_time * (1 - 1e-12)


def is_straight(trajectory, start, goal):
    moves = goal != start
    for u in (0.11, 0.37, 0.5):
        gone = np.array(trajectory.at_time(trajectory.duration * u)[0]) - start
        if not moves.any() or np.ptp(gone[moves] / (goal - start)[moves]) > 1e-9:
            return False
    return True


@pytest.mark.parametrize("joints", MOTIONS)
def test_phases_that_ruckig_synchronises(joints, build, seed):
    """Where one joint's phases do for all, Ruckig's motion is straight, and ours is as quick. With
    all limits of a joint in proportion to the first one's that is common."""
    motions = random_motions(joints, seed + 2)
    motions[:, :3] = motions[:, :3, :1] * np.linspace(1, 1.2, joints)
    durations, _, _ = beeline_answers(build, motions)
    straight_ones = 0
    for motion, (_, straight) in zip(motions, durations):
        peer = ruckig_trajectory(*motion, ruckig.Synchronization.Phase)
        if is_straight(peer, *motion[3:]):
            straight_ones += 1
            assert_close(straight, peer.duration, straight)
    assert straight_ones > len(motions) / 2
