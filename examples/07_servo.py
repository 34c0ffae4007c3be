"""
A control loop
==============

The tool of a Panda follows a figure of eight by commanded velocities, within the limits of the joints.
"""

import numpy as np
from numpy.typing import NDArray

import beeline

panda = beeline.arms.panda()
q = np.array([0, -0.785, 0, -2.356, 0, 1.571, 0.785])
middle = beeline.forward_kinematics(panda, q)
dt = 1e-3


def eight(t: float) -> NDArray[np.float64]:
    """The commanded position at time t from the centre: 20 cm wide, 10 cm high, after one second of acceleration."""
    angle = np.pi * (t * t / 2 if t < 1 else t - 0.5)
    return np.array([0, 0.1 * np.sin(angle), 0.05 * np.sin(2 * angle)])


servo = beeline.Servo(panda, time_step=dt)
times, positions, farthest = [0.0], [q.copy()], 0.0
for i in range(2500):
    error = middle[:3, 3] + eight(i * dt) - beeline.forward_kinematics(panda, q)[:3, 3]
    command = np.zeros(6)
    command[:3] = 10 * error + (eight((i + 1) * dt) - eight(i * dt)) / dt
    step = servo.step(q, command)
    q = q + dt * step.velocity  # an ideal arm
    farthest = max(farthest, float(np.linalg.norm(error)))
    if i % 25 == 24:
        times.append((i + 1) * dt)
        positions.append(q.copy())

print(f"at most {1000 * farthest:.3f} mm from the path")
assert farthest < 1e-3
trail = beeline.Trajectory(panda.joint_names, times, positions)
beeline.draw(panda, trail, waypoints=[middle]).save("07_servo.svg")
