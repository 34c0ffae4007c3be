"""
Control in joint space
======================

Dellaert, *Serial Link Manipulators*, eq. 1.3: a small gain is slow, a large one overshoots, and 2 does not converge.
"""

import numpy as np

import beeline

rrr = beeline.arms.rrr()
start = np.zeros(3)
goal = np.radians([99.2, -68.8, -30.4])
for kp in (0.01, 0.1, 0.5, 1.0, 1.5, 2.1):
    motion = beeline.control_joints(rrr, start, goal, kp=kp)
    print(f"K_p {kp}: {motion.status} after {motion.steps} steps, overshoot {100 * motion.overshoot} % {motion.reason}")

# %%
# The joints move along a straight line in joint space, the tool along a curve.
motion = beeline.control_joints(rrr, start, goal, kp=0.1)
beeline.draw(rrr, motion).save("04_joint_control.svg")
