#pragma once

#include <beeline/budget.h>
#include <beeline/io/trajectory_file.h>
#include <beeline/trajectory/limit_usage.h>
#include <beeline/trajectory/trajectory.h>

#include "pose_list_fields.h"

namespace beeline::python {

template <>
inline std::vector<Interpolation> choices() {
  return {Interpolation::linear, Interpolation::cubic, Interpolation::quintic};
}

template <>
inline std::vector<Side> choices() {
  return {Side::before, Side::after};
}
template <>
inline std::string spelling(Side side) {
  return side == Side::before ? "before" : "after";
}

template <>
struct Fields<Trajectory> {
  static constexpr const char* name = "Trajectory";
  static constexpr const char* doc =
      "A motion of n joints as N samples: positions[k] at times[k]. The columns determine the "
      "motion "
      "between the samples, as ros2_control's joint trajectory controller plays it: positions "
      "alone, linear; positions and velocities, the cubic polynomial; with accelerations too, the "
      "quintic one. Its arrays are read-only.";
  static constexpr auto check = [](const Trajectory& trajectory) { check_trajectory(trajectory); };
  static constexpr auto all() {
    return std::tuple(
        field("joint_names", &Trajectory::joint_names, "One for each coordinate."),
        field("times", &Trajectory::times, "Seconds, strictly increasing, (N,)."),
        field("positions", &Trajectory::positions, "rad, or m for prismatic joints, (N, n)."),
        field("velocities", &Trajectory::velocities,
              "rad/s or m/s, (N, n); (0, 0) where they are not known."),
        field("accelerations", &Trajectory::accelerations,
              "rad/s^2 or m/s^2, (N, n); (0, 0) where they are not known."));
  }
};

/// States at one time, arrays (n,), or at times of any shape, arrays (..., n).
struct StateColumn {
  std::vector<Index> shape;
  std::vector<double> values;
  bool operator==(const StateColumn&) const = default;
};

struct States {
  StateColumn position, velocity, acceleration, jerk;
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
struct Fields<States> {
  static constexpr const char* name = "TrajectoryState";
  static constexpr const char* doc =
      "State of n joints at one time, arrays (n,), or at times of any shape, arrays (..., n).";
  static constexpr auto all() {
    return std::tuple(field("position", &States::position, "rad or m."),
                      field("velocity", &States::velocity, "rad/s or m/s."),
                      field("acceleration", &States::acceleration, "rad/s^2 or m/s^2."),
                      field("jerk", &States::jerk, "rad/s^3 or m/s^3."));
  }
};

template <>
struct Fields<JointDifference> {
  static constexpr const char* name = "JointDifference";
  static constexpr const char* doc = "The difference of one coordinate between two trajectories.";
  static constexpr auto all() {
    return std::tuple(field("largest", &JointDifference::largest, "rad or m."),
                      field("time", &JointDifference::time,
                            "Of the largest difference, s from the first samples."),
                      field("rms", &JointDifference::rms,
                            "Root mean square over the common duration, rad or m."));
  }
};

template <>
struct Fields<TrajectoryDifference> {
  using T = TrajectoryDifference;
  static constexpr const char* name = "TrajectoryDifference";
  static constexpr const char* doc = "The difference of two trajectories of an arm.";
  static constexpr auto all() {
    return std::tuple(
        field("joints", &T::joints, "One for each coordinate."),
        field("largest_position", &T::largest_position, "Distance between the tools, m."),
        field("position_time", &T::position_time, "Of that distance, s."),
        field("largest_orientation", &T::largest_orientation, "Angle between the tools, rad."),
        field("orientation_time", &T::orientation_time, "Of that angle, s."),
        field("overlap", &T::overlap, "Common duration, s."),
        field("longer", &T::longer, "Duration of b minus that of a, s."));
  }
};

template <>
struct Fields<MappedJoint> {
  static constexpr const char* name = "MappedJoint";
  static constexpr const char* doc =
      "A joint of a recording that is a coordinate of an arm: unit * (sign * recorded + offset).";
  static constexpr std::size_t required = 1;
  static constexpr auto all() {
    return std::tuple(
        field("name", &MappedJoint::name, "In the recording."),
        field("sign", &MappedJoint::sign, "1 or -1."),
        field("offset", &MappedJoint::offset, "In the recording's unit."),
        field("unit", &MappedJoint::unit,
              "rad or m per unit of the recording; None: that of all angles, or metres."));
  }
};

template <>
struct Fields<UnwrappedJoint> {
  static constexpr const char* name = "UnwrappedJoint";
  static constexpr const char* doc = "A joint whose recorded values jumped by whole revolutions.";
  static constexpr auto all() {
    return std::tuple(
        field("joint", &UnwrappedJoint::joint, "Its name."),
        field("wraps", &UnwrappedJoint::wraps, "Number of jumps."),
        field("first_time", &UnwrappedJoint::first_time, "Of the sample after the first jump, s."));
  }
};

template <>
struct Fields<Unwrapped> {
  static constexpr const char* name = "Unwrapped";
  static constexpr const char* doc =
      "A trajectory without the jumps of sensors whose values wrap after a revolution.";
  static constexpr auto all() {
    return std::tuple(field("trajectory", &Unwrapped::trajectory, "In the arm's order."),
                      field("joints", &Unwrapped::joints, "Those that were changed."));
  }
};

template <>
inline std::vector<TimeUnit> choices() {
  return {TimeUnit::seconds, TimeUnit::milliseconds, TimeUnit::microseconds, TimeUnit::nanoseconds};
}

template <>
struct Fields<LimitFraction> {
  static constexpr const char* name = "LimitFraction";
  static constexpr const char* doc =
      "The largest fraction of one kind of limit that a trajectory uses; above 1 it exceeds the "
      "limit.";
  static constexpr auto all() {
    return std::tuple(
        field("fraction", &LimitFraction::fraction, "Of the limit."),
        field("joint", &LimitFraction::joint, "The joint that uses it; empty for a fraction of 0."),
        field("time", &LimitFraction::time, "Of the sample before it, s."),
        field("exact", &LimitFraction::exact,
              "Whether it is exact for the motion that the columns mean. Otherwise the "
              "interpolation does not bound this derivative, as it jumps at the samples: the "
              "fraction is then what the smoothest motion through the samples needs, by divided "
              "differences."),
        field("assumed", &LimitFraction::assumed, "The limit is not known but assumed."));
  }
};

template <>
struct Fields<LimitUsage> {
  static constexpr const char* name = "LimitUsage";
  static constexpr const char* doc = "The fractions of the arm's limits that a trajectory uses.";
  static constexpr auto all() {
    return std::tuple(
        field("velocity", &LimitUsage::velocity, "Of the velocity limits."),
        field("acceleration", &LimitUsage::acceleration, "Of the acceleration limits."),
        field("jerk", &LimitUsage::jerk, "Of the jerk limits."),
        field("ending", &LimitUsage::ending,
              "`complete`, or what ended the computation: then these are the largest so far."));
  }
};

}  // namespace beeline::python
