"""
An arm of one's own
===================

From a joint string, from a table of Denavit-Hartenberg parameters, from URDF.
"""

import math

import numpy as np

import beeline

planar = beeline.Arm.from_string("RRP:1,0.5,0.2")
print(planar)

# %%
# A table says which convention it follows.
rows = [
    beeline.DhRow(a=0, alpha=math.pi / 2, d=0.3),
    beeline.DhRow(a=0.4),
    beeline.DhRow(a=0.35),
]
arm = beeline.Arm.from_dh(rows, convention="standard", name="three")
beeline.draw(arm, np.radians([30, 40, -60]), frames=True).save("06_own_arm.svg")

# %%
# The text of a URDF file, or its path.
crane = beeline.Arm.from_urdf("""
<robot name="crane">
  <link name="ground"/> <link name="mast"/> <link name="hook"/>
  <joint name="turn" type="continuous">
    <parent link="ground"/> <child link="mast"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="jib" type="prismatic">
    <parent link="mast"/> <child link="hook"/> <origin xyz="1 0 2"/>
    <limit lower="0" upper="2" velocity="0.5" effort="1"/>
  </joint>
</robot>
""")
print(crane.joint_names, beeline.forward_kinematics(crane, [math.pi / 2, 1])[:3, 3])
