#pragma once

#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/control/replay.h>

#include "planning_fields.h"

namespace beeline::python {

template <>
inline std::vector<CartesianMethod> choices() {
  return {CartesianMethod::inverse_jacobian, CartesianMethod::inverse_kinematics};
}

template <>
struct Fields<PidGains> {
  static constexpr const char* name = "PidGains";
  static constexpr auto all() {
    return std::tuple(field("kp", &PidGains::kp, "Proportional gain, above 0."),
                      field("ki", &PidGains::ki, "Integral gain, 0 or more."),
                      field("kd", &PidGains::kd, "Derivative gain, 0 or more."));
  }
};

template <>
inline constexpr bool reports<SimulationOptions> = false;
template <>
struct Fields<SimulationOptions> {
  static constexpr const char* name = "SimulationOptions";
  static constexpr auto all() {
    return std::tuple(
        field("tolerance", &SimulationOptions::tolerance,
              "Max error of a goal that is reached, m and rad, above 0."),
        field("max_steps", &SimulationOptions::max_steps,
              "Of the whole motion, from 1 to 10,000,000."),
        field("time_step", &SimulationOptions::time_step, "Of the controller, s, above 0."),
        field("budget", &SimulationOptions::budget, ""));
  }
};

/// Those besides CartesianOptions::simulation, whose members are keywords too.
template <>
struct Fields<CartesianOptions> {
  using T = CartesianOptions;
  static constexpr const char* name = "CartesianOptions";
  static constexpr auto all() {
    return std::tuple(
        field("method", &T::method,
              "`inverse-jacobian`: the inverse Jacobian maps the tool's pose error to joint space "
              "(Dellaert, eq. 1.6); `inverse-kinematics`: inverse kinematics at intermediate "
              "poses, joint-space control between."),
        field("task", &T::task, "Rows that matter; None: planar for a planar arm, else spatial."),
        field("gain", &T::gain, "Fraction of the error per step, above 0."),
        field("intermediate", &T::intermediate,
              "Number of poses on each line, its end included; for inverse-kinematics only."));
  }
};

template <>
inline constexpr bool reports<JointMoveOptions> = false;
template <>
struct Fields<JointMoveOptions> {
  using T = JointMoveOptions;
  static constexpr const char* name = "JointMoveOptions";
  static constexpr auto all() {
    return std::tuple(
        field("synchronise", &T::synchronise,
              "`time`: each joint has an s-curve of its own, stretched to the duration of the "
              "slowest; `straight`: all joints have one s-curve in proportion, a straight line in "
              "joint space."),
        field("rate", &T::rate, "Samples per second."),
        field("duration", &T::duration,
              "Seconds, a whole number of periods; None: the shortest that the limits allow."),
        field("budget", &T::budget, ""));
  }
};

template <>
struct Fields<ControlledMotion> {
  using T = ControlledMotion;
  static constexpr const char* name = "ControlledMotion";
  static constexpr const char* doc =
      "A motion simulated with a feedback controller, or planned by move_joints().";
  static constexpr const char* truth = "True if reached.";
  static constexpr auto all() {
    return std::tuple(
        field("status", &T::status, "`reached`, or why not."),
        field("reason", &T::reason, "One sentence; empty when reached."),
        field("trajectory", &T::trajectory, "Every step, also when the goal was not reached."),
        field("arrivals", &T::arrivals, "The sample at which each goal was reached."),
        field("steps", &T::steps, "Number of steps."),
        field("slowed", &T::slowed, "Steps that were scaled down for the velocity limits."),
        field("overshoot", &T::overshoot,
              "Largest distance beyond a goal, relative to the distance to it."),
        field("error", &T::error, "Remaining error of the last goal, rad or m."));
  }
};

template <>
struct Fields<SpeedChange> {
  static constexpr const char* name = "SpeedChange";
  static constexpr const char* doc = "A change of the target speed during a replay.";
  static constexpr std::size_t required = 2;
  static constexpr bool as_tuple = true;
  static constexpr auto all() {
    return std::tuple(
        field("time", &SpeedChange::time, "Since the start of playing, lead-in included, s."),
        field("speed", &SpeedChange::speed, "From 0, a pause, to 1, the recording's own speed."));
  }
};

template <>
inline constexpr bool reports<ReplayOptions> = false;
template <>
struct Fields<ReplayOptions> {
  static constexpr const char* name = "ReplayOptions";
  static constexpr auto all() {
    return std::tuple(
        field("rate", &ReplayOptions::rate,
              "Samples per second; 0: the recorded samples or, with `speed_at`, 100 per second."),
        field("speed", &ReplayOptions::speed, "Above 0: 1 is the recording's own speed."),
        field("start", &ReplayOptions::start,
              "The arm's configuration, from which a motion leads to the first sample; None: it "
              "begins at the first sample."),
        field("speed_at", &ReplayOptions::speed_at,
              "Pairs (time, speed) at increasing times; none: `speed` throughout."),
        field("ramp", &ReplayOptions::ramp,
              "Time in which the speed changes by 1, s, above 0; for `speed_at` only."),
        field("no_unwrap", &ReplayOptions::no_unwrap,
              "Keep the jumps of continuous joints whose values wrap."),
        field("limit_tolerance", &ReplayOptions::limit_tolerance,
              "Fraction, 0 to 0.1, by which a recorded velocity may exceed its limit, for the "
              "rounding of other planners."),
        field("budget", &ReplayOptions::budget, ""));
  }
};

template <>
struct Fields<Replay> {
  static constexpr const char* name = "Replay";
  static constexpr const char* doc = "A recording as it is replayed on an arm.";
  static constexpr const char* truth = "True if reached.";
  static constexpr auto all() {
    return std::tuple(
        field("status", &Replay::status, "`reached`, or why not."),
        field("reason", &Replay::reason, "One sentence; empty when reached."),
        field("trajectory", &Replay::trajectory, "Empty unless reached."),
        field("lead_in", &Replay::lead_in,
              "Duration of the motion from `start` to the first sample, s."),
        field("slowdown", &Replay::slowdown,
              "The recording's duration as a multiple of that which was asked for."),
        field("limits", &Replay::limits,
              "Of the trajectory, or of a recording that is too fast at this speed."),
        field("unwrapped", &Replay::unwrapped, "Joints of the recording that were unwrapped."));
  }
};

}  // namespace beeline::python
