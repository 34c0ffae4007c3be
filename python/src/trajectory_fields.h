#pragma once

#include <beeline/budget.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/trajectory/limit_usage.h>
#include <beeline/trajectory/trajectory.h>

#include "pose_list_fields.h"

namespace beeline::python {

template <>
struct Fields<Trajectory>
    : Members<&Trajectory::joint_names, &Trajectory::times, &Trajectory::positions,
              &Trajectory::velocities, &Trajectory::accelerations> {
  static constexpr auto check = [](const Trajectory& trajectory) { check_trajectory(trajectory); };
};

/// A column of States.
struct StateColumn {
  std::vector<Index> shape;
  std::vector<double> values;
  bool operator==(const StateColumn&) const = default;
};

/// State of n joints at one time, arrays (n,), or at times of any shape, arrays (..., n).
struct States {
  StateColumn position;      ///< rad or m
  StateColumn velocity;      ///< rad/s or m/s
  StateColumn acceleration;  ///< rad/s^2 or m/s^2
  StateColumn jerk;          ///< rad/s^3 or m/s^3
};

template <>
struct Value<StateColumn> {
  static constexpr bool large = true;
  static std::string type() { return array_type; }
  static nb::object to(const StateColumn& value);
  static StateColumn from(nb::handle value, const char* name);
  static bool same(const StateColumn& a, const StateColumn& b) { return a == b; }
};

template <>
struct Fields<States>
    : Members<&States::position, &States::velocity, &States::acceleration, &States::jerk> {
  static constexpr const char* name = "TrajectoryState";
};

template <>
struct Fields<JointDifference>
    : Members<&JointDifference::largest, &JointDifference::time, &JointDifference::rms> {};

template <>
struct Fields<TrajectoryDifference>
    : Members<&TrajectoryDifference::joints, &TrajectoryDifference::largest_position,
              &TrajectoryDifference::position_time, &TrajectoryDifference::largest_orientation,
              &TrajectoryDifference::orientation_time, &TrajectoryDifference::overlap,
              &TrajectoryDifference::longer> {};

template <>
struct Fields<MappedJoint>
    : Members<&MappedJoint::name, &MappedJoint::sign, &MappedJoint::offset, &MappedJoint::unit> {
  static constexpr std::size_t required = 1;
};

template <>
struct Fields<UnwrappedJoint>
    : Members<&UnwrappedJoint::joint, &UnwrappedJoint::wraps, &UnwrappedJoint::first_time> {};

template <>
struct Fields<Unwrapped> : Members<&Unwrapped::trajectory, &Unwrapped::joints> {};

template <>
struct Fields<LimitFraction>
    : Members<&LimitFraction::fraction, &LimitFraction::joint, &LimitFraction::time,
              &LimitFraction::exact, &LimitFraction::assumed> {};

template <>
struct Fields<Recovery>
    : Members<&Recovery::excess, &Recovery::joint, &Recovery::sample, &Recovery::time> {};

template <>
struct Fields<LimitUsage>
    : Members<&LimitUsage::position, &LimitUsage::velocity, &LimitUsage::acceleration,
              &LimitUsage::jerk, &LimitUsage::ending> {};

}  // namespace beeline::python
