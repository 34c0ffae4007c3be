"""
Straight lines with a proof
===========================

The tool moves in straight lines through waypoints. The deviation is measured, and proved at all times.
"""

import numpy as np

import beeline

rrr = beeline.arms.rrr()
waypoints = [beeline.parse_pose(pose, "degrees", "planar") for pose in ("6,2.5,30", "-0.5,6.5,120", "-4,2.5,180")]
motion = beeline.move_in_lines(rrr, np.radians([0, 90, 0]), waypoints)
assert motion, motion.reason
print(motion)
print("measured", motion.deviation.measured)
print("proved  ", motion.deviation.bound)

beeline.draw(rrr, motion, waypoints=waypoints).save("05_straight_line.svg")

# %%
# Joints and tool over time, with their limits.
beeline.timing_figure(rrr, motion.trajectory).save("05_timing.svg")
