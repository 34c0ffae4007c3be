"""
Inverse kinematics
==================

Both elbow solutions of the planar arm, and the reason when there is none.
"""

import numpy as np

import beeline

rrr = beeline.arms.rrr()
goal = beeline.Pose2(x=4.459, y=5.226, theta=0)
answer = beeline.inverse_kinematics(rrr, goal, all=True)
for q in answer.solutions:
    print("solution", np.degrees(q), "deg")
    assert np.allclose(beeline.forward_kinematics(rrr, q), beeline.to_space(goal))

beeline.draw(rrr, answer.solutions[0], title="One of two").save("03_inverse_kinematics.svg")

# %%
# A negative answer is a result that is false and has a reason, not an exception.
far = beeline.inverse_kinematics(rrr, [8, 8, 0])  # x, y, theta
print(far.status, far.reason)
assert not far
