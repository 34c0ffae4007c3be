"""
Batches
=======

A million configurations of a Panda, their tool poses, and inverse kinematics of some: arrays in and out, all cores.
"""

import numpy as np

import beeline

panda = beeline.arms.panda()
random = np.random.default_rng(1)
q = random.uniform(panda.lower, panda.upper, (1_000_000, 7))
poses = beeline.forward_kinematics(panda, q)
print("mean height of the tool", poses[:, 2, 3].mean(), "m")

result = beeline.batch_inverse(panda, poses[:1000], seed=q[:1000])
again = beeline.forward_kinematics(panda, result.q)
print(result.solved, "of 1000 solved, error at most", abs(again - poses[:1000]).max())
beeline.draw(panda, q[0], caption="The first of a million").save("09_batch.svg")
assert result.solved == 1000 and np.allclose(again, poses[:1000])
