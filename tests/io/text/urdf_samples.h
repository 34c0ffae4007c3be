#pragma once

#include <string>

namespace beeline::testing {

/// <robot> around the elements; they begin on line 2.
inline std::string robot(const std::string& elements) {
  return "<robot name=\"r\">\n" + elements + "</robot>\n";
}

inline std::string link(const std::string& name) { return "<link name=\"" + name + "\"/>\n"; }

/// A joint on one line; `inside` is what it contains besides its parent and child.
inline std::string joint(const std::string& name, const std::string& type,
                         const std::string& parent, const std::string& child,
                         const std::string& inside = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + inside + "</joint>\n";
}

/// Every element that the reader hears, and some that it passes over.
inline const std::string whole_urdf = R"(<?xml version="1.0"?>
<!-- a small arm with a gripper -->
<robot name="small arm">
  <material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
  <link name="base">
    <inertial><mass value="1"/></inertial>
    <visual><geometry><mesh filename="package://nowhere/base.dae"/></geometry></visual>
  </link>
  <link name="shoulder"/>
  <link name="elbow"/>
  <link name="flange"/>
  <link name="left"/>
  <link name="right"/>
  <joint name="pan" type="continuous">
    <origin xyz="0 0 0.5" rpy="0.1 -0.2 0.3"/>
    <parent link="base"/>
    <child link="shoulder"/>
    <axis xyz="0 0 2"/>
    <limit effort="10" velocity="3"/>
  </joint>
  <joint name="lift" type="revolute">
    <origin xyz=" 0.1	0  0 "/>
    <parent link="shoulder"/>
    <child link="elbow"/>
    <limit effort="10" velocity="0" lower="-1.5" upper="+2"/>
  </joint>
  <joint name="mount" type="fixed">
    <origin xyz="0.4 0 0" rpy="0 1.5708 0"/>
    <parent link="elbow"/>
    <child link="flange"/>
    <axis xyz="0 0 0"/>
  </joint>
  <joint name="left_finger" type="prismatic">
    <origin xyz="0 0.01 0.1"/>
    <parent link="flange"/>
    <child link="left"/>
    <axis xyz="0 1 0"/>
    <limit effort="1" velocity="0.2" lower="0" upper="0.04"/>
  </joint>
  <joint name="right_finger" type="prismatic">
    <origin xyz="0 -0.01 0.1"/>
    <parent link="flange"/>
    <child link="right"/>
    <axis xyz="0 -1 0"/>
    <limit effort="1" velocity="0.2" lower="0" upper="0.04"/>
    <mimic joint="left_finger"/>
  </joint>
  <transmission name="t"><joint name="pan"/></transmission>
</robot>
)";

/// Groups and states of whole_urdf.
inline const std::string whole_srdf = R"(<?xml version="1.0"?>
<robot name="small arm">
  <virtual_joint name="world" type="fixed" parent_frame="world" child_link="base"/>
  <group name="arm"><chain base_link="base" tip_link="flange"/></group>
  <group name="hand"><link name="left"/><joint name="right_finger"/></group>
  <group name="small">
    <group name="arm"/>
    <joint name="left_finger"/>
  </group>
  <group_state name="home" group="arm">
    <joint name="pan" value="0.5"/>
    <joint name="lift" value="-1e-1"/>
  </group_state>
  <end_effector name="hand" parent_link="flange" group="hand"/>
  <disable_collisions link1="base" link2="shoulder" reason="Adjacent"/>
</robot>
)";

}  // namespace beeline::testing
