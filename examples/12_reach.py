"""
Reach
=====

What a UR5e can do around it: at each position of a grid, in each direction of its tool, whether it reaches the pose and
how far from its joint limits.
"""

import math

import numpy as np

import beeline

arm = beeline.arms.ur5e()
map = beeline.reach_map(arm, resolution=0.15, directions=math.radians(45))
totals = map.totals()
print(f"{totals.reached} of {totals.cells} cells reached, at {totals.reached_positions} of {totals.positions} positions")

beeline.reach_figure(beeline.slice_of(map, "z", 0.3)).save("12_reach.svg")

# %%
# The cells are arrays: here the positions from which the tool can point straight down, and with what margin at best.
down = int(np.argmin(map.grid.directions[:, 2]))
margin = map.margin[..., down]
print(f"{np.isfinite(margin).sum()} positions, margin {np.nanmax(margin):.2f} at most")

# %%
# Where can the arm stand so that it reaches three poses above a table?
upside_down = beeline.RollPitchYaw(roll=math.pi)
poses = [beeline.make_pose(point, rpy=upside_down) for point in ([0.8, -0.3, 0.2], [0.8, 0.3, 0.2], [1, 0, 0.4])]
found = beeline.find_placements(map, poses, count=1)
best = found.placements[0]
print(f"{found.reaching} of {found.checked} mounts reach the poses; the best, with a margin of {best.margin:.2f}:")
print(best.world_T_mount.round(3))

there = arm.with_mount(best.world_T_mount)
tools = beeline.forward_kinematics(there, best.solutions)
assert abs(tools - np.array(poses)).max() < 1e-6
