"""
Ten lines
=========

An arm, the pose of its tool, inverse kinematics and a straight line.
"""

import numpy as np

import beeline

arm = beeline.arms.panda()  # or beeline.Arm.load("robot.urdf"), or "RRR:3.5,3.5,2"
q = arm.middle
pose = beeline.forward_kinematics(arm, q)
pose[2, 3] -= 0.1  # 0.1 m lower
found = beeline.inverse_kinematics(arm, pose, seed=q)
print(found)
motion = beeline.move_in_lines(arm, q, [pose])
print(motion)

# %%
# Results are true if they are solved. Both are confirmed here independently.
assert found and motion
assert np.allclose(beeline.forward_kinematics(arm, found.solutions[0]), pose)
assert beeline.verify(arm, motion.trajectory, [pose])

beeline.draw(arm, motion, waypoints=[pose]).save("00_ten_lines.svg")
