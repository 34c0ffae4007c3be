"""
Ten lines
=========

An arm, its tool pose, its Jacobian, inverse kinematics and a straight line.
"""

import numpy as np

import beeline

arm = beeline.Arm.load("panda")  # or "robot.urdf", or "RRR:3.5,3.5,2"
q = arm.middle
tool = beeline.forward_kinematics(arm, q)
j = beeline.jacobian(arm, q)  # base frame, rows vx vy vz wx wy wz
higher = tool.copy()
higher[2, 3] += 0.1
answer = beeline.inverse_kinematics(arm, higher, seed=q)
motion = beeline.move_in_lines(arm, q, [higher, tool])

print("tool\n", tool)
print("Jacobian\n", j)
print(answer)
print(motion)

# %%
# Results are true if they are solved. The inverse and the motion are confirmed here independently.
assert answer and motion
assert np.allclose(beeline.forward_kinematics(arm, answer.solutions[0]), higher)
assert beeline.verify(arm, motion.trajectory, [higher, tool])

beeline.draw(arm, motion, waypoints=[higher, tool]).save("00_ten_lines.svg")
