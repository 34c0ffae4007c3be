"""
Inverse kinematics
==================

Both elbow solutions of the planar arm, and the reason when there is none.
"""

import numpy as np

import beeline

rrr = beeline.arms.rrr()
goal = beeline.parse_pose("4.459,5.226,0")  # x, y, theta
answer = beeline.inverse_kinematics(rrr, goal, all=True)
for q in answer.solutions:
    print("solution", np.degrees(q), "deg")
    assert np.allclose(beeline.forward_kinematics(rrr, q), goal)

beeline.draw(rrr, answer.solutions[0], title="One of two").save("03_inverse_kinematics.svg")

# %%
# A negative answer is a result that is false and has a reason, not an exception.
far = beeline.inverse_kinematics(rrr, beeline.parse_pose("8,8,0"))
print(far.status, far.reason)
assert not far
