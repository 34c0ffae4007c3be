#pragma once

#include <string>

namespace beeline::testing {

/// <mujoco> around the bodies of the world, which begin on line 3; `sections` stand before them on
/// line 1.
inline std::string mujoco(const std::string& bodies, const std::string& sections = "") {
  return "<mujoco model=\"m\">" + sections + "\n<worldbody>\n" + bodies + "</worldbody></mujoco>\n";
}

/// An arm of two hinges with a gripper, and most of what the reader hears.
inline const std::string whole_mjcf = R"(<?xml version="1.0"?>
<!-- a small arm -->
<mujoco model="small arm">
  <compiler angle="radian" eulerseq="XYZ"/>
  <default>
    <joint axis="0 1 0" range="-2 2"/>
    <default class="finger"><joint type="slide" range="0 0.04" ref="0.01"/></default>
  </default>
  <asset><mesh name="palm" vertex="0 0 0 0.1 0 0 0 0.1 0 0 0 0.1" scale="1 2 -1"/></asset>
  <worldbody>
    <geom type="box" size="1 1 0.1" pos="0 0 -0.1"/>
    <body name="base" pos="0 0 0.5" quat="1 0 0 1">
      <joint name="pan" axis="0 0 1" limited="false"/>
      <geom type="cylinder" size="0.1 0.2"/>
      <frame pos="0 0 0.1" euler="0 0.1 0">
        <body name="upper" childclass="main">
          <joint name="lift" pos="0 0 0.05"/>
          <geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.05"/>
          <body name="hand" pos="0.4 0 0" zaxis="1 0 0">
            <geom type="mesh" mesh="palm"/>
            <site name="grasp" pos="0 0 0.1" axisangle="0 0 1 0.5"/>
            <body name="left" pos="0 0.02 0.1">
              <joint name="left_finger" class="finger"/><geom size="0.01"/>
            </body>
            <body name="right" pos="0 -0.02 0.1" xyaxes="1 0 0 0 -1 0">
              <joint name="right_finger" class="finger"/><geom type="sphere" size="0.01"/>
            </body>
          </body>
        </body>
      </frame>
    </body>
  </worldbody>
  <contact><exclude body1="base" body2="upper"/></contact>
  <equality><joint joint1="right_finger" joint2="left_finger" polycoef="0 1"/></equality>
  <actuator><position joint="pan" ctrlrange="-1 1"/></actuator>
</mujoco>
)";

}  // namespace beeline::testing
