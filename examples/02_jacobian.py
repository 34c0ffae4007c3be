"""
The Jacobian
============

Dellaert, *Serial Link Manipulators*, eq. 1.4 and Figure 1.8. Rows are vx vy vz wx wy wz, a column for each joint.
"""

import numpy as np

import beeline

rrr = beeline.arms.rrr()
q = np.radians([0, 90, 0])
j = beeline.jacobian(rrr, q)
print("rows x, y, theta:\n", j[[0, 1, 5]])
assert np.allclose(j[[0, 1, 5]], [[-5.5, -5.5, -2.0], [3.5, 0.0, 0.0], [1.0, 1.0, 1.0]])

beeline.draw(rrr, q, jacobian=True).save("02_jacobian.svg")

# %%
# The same in the axes of the tool, and how far the arm is from a singularity.
panda = beeline.arms.panda()
print("panda, in tool axes:\n", beeline.jacobian(panda, panda.middle, "tool"))
print("manipulability", beeline.manipulability(panda, panda.middle))
