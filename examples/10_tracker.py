"""
Teleoperation
=============

A UR5e follows poses that a hand controller sends 90 times a second. The hand jumps once and reaches too far; the limits
of the joints hold.
"""

from collections import Counter

import numpy as np
from numpy.typing import NDArray

import beeline

arm = beeline.arms.ur5e()
home = np.array([0.3, -1.2, 1.6, -0.8, -1.2, 0.2])
start = beeline.forward_kinematics(arm, home)
dt, period = 1e-3, 1 / 90


def hand(t: float) -> NDArray[np.float64]:
    """The commanded pose: circles of 10 cm, a jump of 20 cm after 4 s, further out from 6 to 8 s."""
    pose = np.array(start)
    pose[:3, 3] += [0.05 * np.sin(2 * t), 0.05 * np.cos(2 * t), 0.2 if t > 4 else 0]
    if 6 < t < 8:
        pose[:3, 3] *= 1.8
    return pose


tracker = beeline.Tracker(arm, home, time_step=dt, command_period=period)
statuses: Counter[str] = Counter()
times, positions = [0.0], [home]
command, next_command, fastest, error = start, 0.0, 0.0, 0.0
for t in np.arange(0, 12, dt):
    if t >= next_command:
        command = hand(float(t))
        next_command += period
    step = tracker.step(command)  # send step.q to the arm
    statuses[step.status] += 1
    fastest = max(fastest, float(abs(step.velocity).max()))
    if t > 10:
        error = max(error, step.error.position)
    if t >= 0.1 * len(times):
        times.append(float(t))
        positions.append(np.array(step.q))

print(dict(statuses))
print(f"fastest joint {fastest:.3f} rad/s, error after the jumps at most {1e6 * error:.1f} micrometres")
assert error < 1e-4

trail = beeline.Trajectory(arm.joint_names, times, positions)
beeline.draw(arm, trail).save("10_tracker.svg")
