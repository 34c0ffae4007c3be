#pragma once

#include <beeline/control/player.h>
#include <beeline/control/servo.h>
#include <beeline/control/tracker.h>

#include "path_fields.h"

namespace beeline::python {

template <>
struct Fields<ServoOptions>
    : Members<&ServoOptions::task, &ServoOptions::time_step, &ServoOptions::gain,
              &ServoOptions::linear_speed, &ServoOptions::angular_speed> {};

template <>
struct Fields<TrackerOptions>
    : Members<&TrackerOptions::task, &TrackerOptions::time_step, &TrackerOptions::command_period,
              &TrackerOptions::tolerance> {};

/// One step of a Servo.
struct ServoMotion {
  Configuration velocity;  ///< of the joints, rad/s or m/s
  double scale = 1;
  ServoLimit limit = ServoLimit::none;
  std::optional<int> joint = std::nullopt;
};
inline std::ostream& operator<<(std::ostream& out, const ServoMotion& motion) {
  return out << ServoStep{motion.scale, motion.limit, motion.joint};
}

template <>
struct Fields<ServoMotion> : Members<&ServoMotion::velocity, &ServoMotion::scale,
                                     &ServoMotion::limit, &ServoMotion::joint> {
  static constexpr const char* name = "ServoStep";
};

template <>
struct Fields<PlayerOptions>
    : Members<&PlayerOptions::time_step, &PlayerOptions::speed, &PlayerOptions::ramp> {};

template <>
struct Fields<Command> : Members<&Command::q, &Command::velocity> {};

template <>
struct Fields<TrackingError>
    : Members<&TrackingError::largest, &TrackingError::rms, &TrackingError::steps> {};

template <>
struct Fields<TrackerStep>
    : Members<&TrackerStep::q, &TrackerStep::velocity, &TrackerStep::status, &TrackerStep::error,
              &TrackerStep::limit, &TrackerStep::joint, &TrackerStep::assumed> {};

}  // namespace beeline::python
