#pragma once

namespace beeline::testing {

/// MoveIt's file for a Panda, with its hand, as the setup assistant writes it.
constexpr const char* panda_limits = R"(# joint_limits.yaml allows the dynamics to be overwritten
default_velocity_scaling_factor: 0.1
default_acceleration_scaling_factor: 0.1
joint_limits:
  joint1: &large
    has_velocity_limits: true
    max_velocity: 2
    has_acceleration_limits: true
    max_acceleration: 3.75
    has_jerk_limits: false
  joint2:
    <<: *large
    max_velocity: 1.5
  joint3:
    has_velocity_limits: true
    max_velocity: 2.1750
    has_acceleration_limits: false
    max_acceleration: 0
    max_position: 2.5
  hand_joint1:
    has_velocity_limits: true
    max_velocity: 0.1
  hand_joint2: {max_velocity: 0.1}
)";

/// The file of Universal Robots: degrees, and names without _joint in older releases.
constexpr const char* ur_limits = R"(joint_limits:
  shoulder_pan:
    # acceleration limits are not publicly available
    has_acceleration_limits: false
    has_effort_limits: true
    has_position_limits: true
    has_velocity_limits: true
    max_effort: 150.0
    max_position: !degrees  360.0
    max_velocity: !degrees  180.0
    min_position: !degrees -360.0
  elbow_joint:
    has_position_limits: true
    min_position: !degrees -180.0
    max_position: !degrees  180.0
    max_velocity: !degrees  180
    max_acceleration: !degrees 800
    max_deceleration: !radians -8
  wrist_3_joint:
    has_position_limits: false
    has_velocity_limits: yes
    max_velocity: !degrees  360.0
)";

/// Parameters of ROS 2 nodes, in the order of ros2_control.
constexpr const char* ros_limits = R"(/**:
  ros__parameters:
    use_sim_time: false
    robot_description_planning:
      default_velocity_scaling_factor: 0.5
      joint_limits:
        joint1: {has_velocity_limits: true, max_velocity: 1, has_soft_limits: false}
        joint2: {has_position_limits: true, min_position: -1, max_position: 1, max_jerk: 1e3}
)";

}  // namespace beeline::testing
