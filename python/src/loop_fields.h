#pragma once

#include <beeline/control/player.h>
#include <beeline/control/servo.h>
#include <beeline/control/tracker.h>

#include "path_fields.h"

namespace beeline::python {

template <>
inline std::vector<ServoLimit> choices() {
  return {ServoLimit::none, ServoLimit::velocity, ServoLimit::acceleration, ServoLimit::position,
          ServoLimit::singular};
}

template <>
inline std::vector<TrackerStatus> choices() {
  return {TrackerStatus::following, TrackerStatus::limited, TrackerStatus::singular,
          TrackerStatus::unreachable};
}

template <>
struct Fields<ServoOptions> {
  static constexpr const char* name = "ServoOptions";
  static constexpr auto all() {
    return std::tuple(
        field("task", &ServoOptions::task,
              "Rows that matter; None: planar for a planar arm, else spatial."),
        field("time_step", &ServoOptions::time_step, "Of the control loop, s, above 0."),
        field("gain", &ServoOptions::gain,
              "Of step_towards(), 1/s: the error's decay rate, above 0 and at most 1 / time_step."),
        field("linear_speed", &ServoOptions::linear_speed,
              "Limit of step_towards()'s command, m/s, above 0."),
        field("angular_speed", &ServoOptions::angular_speed,
              "Limit of step_towards()'s command, rad/s, above 0."));
  }
};

template <>
struct Fields<TrackerOptions> {
  static constexpr const char* name = "TrackerOptions";
  static constexpr auto all() {
    return std::tuple(
        field("task", &TrackerOptions::task,
              "Rows that matter; None: planar for a planar arm, else spatial."),
        field("time_step", &TrackerOptions::time_step, "Between two steps, s, above 0."),
        field("command_period", &TrackerOptions::command_period,
              "Between two commands that differ, s: each is approached in a straight line during "
              "this time. Up to `time_step`: commands are followed at once."),
        field("tolerance", &TrackerOptions::tolerance,
              "Of the status `following`, m and rad, above 0; default: 1e-6 of both."));
  }
};

/// A step of Servo with its velocities.
struct ServoMotion {
  Configuration velocity;
  double scale = 1;
  ServoLimit limit = ServoLimit::none;
  std::optional<int> joint = std::nullopt;
};
inline std::ostream& operator<<(std::ostream& out, const ServoMotion& motion) {
  return out << ServoStep{motion.scale, motion.limit, motion.joint};
}

template <>
struct Fields<ServoMotion> {
  static constexpr const char* name = "ServoStep";
  static constexpr const char* doc = "One step of a Servo.";
  static constexpr auto all() {
    return std::tuple(
        field("velocity", &ServoMotion::velocity, "Of the joints, rad/s or m/s, (n,)."),
        field("scale", &ServoMotion::scale,
              "The fraction of the command that the step achieves, in [0, 1]."),
        field("limit", &ServoMotion::limit, "The limit that determines the scale."),
        field("joint", &ServoMotion::joint, "The coordinate of the limit, from 0."));
  }
};

template <>
struct Fields<PlayerOptions> {
  static constexpr const char* name = "PlayerOptions";
  static constexpr auto all() {
    return std::tuple(
        field("time_step", &PlayerOptions::time_step, "Of the control loop, s, above 0."),
        field("speed", &PlayerOptions::speed,
              "Initial target speed: from 0, a pause, to 1, the recording's own speed."),
        field("ramp", &PlayerOptions::ramp,
              "Min time in which the speed changes by 1, s, above 0."));
  }
};

template <>
struct Fields<Command> {
  static constexpr const char* name = "Command";
  static constexpr const char* doc = "Set points of one step of a control loop.";
  static constexpr auto all() {
    return std::tuple(field("q", &Command::q, "rad or m, (n,)."),
                      field("velocity", &Command::velocity, "At that time, rad/s or m/s, (n,)."));
  }
};

template <>
struct Fields<TrackingError> {
  static constexpr const char* name = "TrackingError";
  static constexpr const char* doc =
      "The difference between measured and commanded positions, rad or m.";
  static constexpr auto all() {
    return std::tuple(
        field("largest", &TrackingError::largest, "Of each coordinate, (n,)."),
        field("rms", &TrackingError::rms, "Root mean square of each coordinate, (n,)."),
        field("steps", &TrackingError::steps, "Number of measurements."));
  }
};

template <>
struct Fields<TrackerStep> {
  static constexpr const char* name = "TrackerStep";
  static constexpr const char* doc = "One step of a Tracker: the configuration at its end.";
  static constexpr auto all() {
    return std::tuple(
        field("q", &TrackerStep::q, "rad or m, within the position limits, (n,)."),
        field("velocity", &TrackerStep::velocity,
              "Of the step, rad/s or m/s: (q - the last q) / time_step, (n,)."),
        field("status", &TrackerStep::status,
              "`following`: the tool is at the commanded pose; `limited`: a joint limit of this "
              "step leaves an error; `singular`: the error decreases slowly near a singularity; "
              "`unreachable`: no small motion of the joints brings the tool nearer."),
        field("error", &TrackerStep::error, "Of the tool at q from the commanded pose."),
        field("limit", &TrackerStep::limit, "With the status `limited`: the limit."),
        field("joint", &TrackerStep::joint, "Its coordinate, from 0."),
        field("assumed", &TrackerStep::assumed, "Whether the limit is assumed."));
  }
};

}  // namespace beeline::python
