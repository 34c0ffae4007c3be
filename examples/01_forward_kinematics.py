"""
Forward kinematics
==================

Dellaert, *Serial Link Manipulators*, eq. 1.1 and Figure 1.6: the chapter's planar arm, and a Panda.
"""

import numpy as np

import beeline

rrr = beeline.arms.rrr()
q = np.radians([112, -52, -60])
tool = beeline.forward_kinematics(rrr, q)
print("rrr: x", tool[0, 3], "y", tool[1, 3], "theta", np.degrees(np.arctan2(tool[1, 0], tool[0, 0])))
assert np.allclose(tool[:2, 3], [2.43888, 6.27623], atol=1e-5)

beeline.draw(rrr, q).save("01_forward_kinematics.svg")

# %%
# Many configurations are one call: a row for each, a pose for each.
panda = beeline.arms.panda()
random = np.random.default_rng(1)
poses = beeline.forward_kinematics(panda, random.uniform(panda.lower, panda.upper, (1000, 7)))
print(poses.shape, "mean height of the tool", poses[:, 2, 3].mean(), "m")
