"""
Obstacles
=========

A motion that is proved to keep its clearance at all times, and one that collides.
"""

import numpy as np

import beeline

rrr = beeline.arms.rrr()

# A capsule lies along each link, whose frame is at its end.
links = []
for i, length in enumerate((3.5, 3.5, 2), start=1):
    along = np.array([[0, 0, 1, -length / 2], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
    links.append(beeline.LinkShapes(f"link{i}", i, [beeline.Shape(beeline.Capsule(0.1, length), along)]))

place = np.eye(4)
place[:3, 3] = 1, 6.2, 0
post = beeline.Obstacle("post", [beeline.Shape(beeline.Cylinder(0.15, 3), place)], clearance=0.05)
model = beeline.CollisionModel(rrr, links, beeline.Scene(obstacles=[post]))

start = [0, 1.57, 0]
clear = beeline.move_joints(rrr, start, [0.5, 1, 0.3]).trajectory
proof = beeline.prove_clearance(model, clear, closest=True)
print(f"{proof.status}: at least {proof.least_distance:.4f} m, closest {proof.pair.names} at {proof.time:.3f} s")
assert proof

nearest = beeline.nearest_pair(model, start)
print(f"at the start {nearest.names}: {nearest.lower:.4f} m, gradient {nearest.gradient}")

# %%
# The motion among its obstacles, with the two bodies that come closest. `beeline.plot.motion()` draws the same with matplotlib.
beeline.draw(model, clear).save("13_obstacles.svg")

# %%
# A motion that is too close is refused, with the pair, the place and the time.
collision = beeline.prove_clearance(model, beeline.move_joints(rrr, start, [2.1, 0, 0]).trajectory)
print(f"{collision.status}: {collision.reason}")
assert not collision and collision.pair.names[1] == "post"
