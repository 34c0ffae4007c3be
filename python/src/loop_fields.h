#pragma once

#include <beeline/control/player.h>
#include <beeline/control/servo.h>
#include <beeline/control/tracker.h>

#include "collision_fields.h"
#include "path_fields.h"

namespace beeline::python {

/// The text, in memory that lives as long as the process: results outlive the model whose names
/// they have.
std::string_view kept_name(std::string_view text);

template <>
struct Value<std::string_view> {
  static std::string type() { return "str"; }
  static nb::object to(std::string_view value) { return nb::str(value.data(), value.size()); }
  static std::string_view from(nb::handle value, const char* name) {
    return kept_name(Value<std::string>::from(value, name));
  }
  static bool same(std::string_view a, std::string_view b) { return a == b; }
};

inline std::optional<BodyNames> kept_names(std::optional<BodyNames> names) {
  if (names) names = {kept_name((*names)[0]), kept_name((*names)[1])};
  return names;
}

template <>
struct Fields<ServoOptions>
    : Members<&ServoOptions::task, &ServoOptions::time_step, &ServoOptions::gain,
              &ServoOptions::linear_speed, &ServoOptions::angular_speed, &ServoOptions::model,
              &ServoOptions::damper_gain> {};

template <>
struct Fields<TrackerOptions>
    : Members<&TrackerOptions::task, &TrackerOptions::time_step, &TrackerOptions::command_period,
              &TrackerOptions::tolerance, &TrackerOptions::model, &TrackerOptions::damper_gain> {};

/// One step of a Servo.
struct ServoMotion {
  Configuration velocity;  ///< of the joints, rad/s or m/s
  double scale = 1;
  ServoLimit limit = ServoLimit::none;
  std::optional<int> joint = std::nullopt;
  std::optional<BodyNames> bodies = std::nullopt;
  bool proved = true;
};
inline std::ostream& operator<<(std::ostream& out, const ServoMotion& motion) {
  return out << ServoStep{motion.scale, motion.limit, motion.joint, motion.bodies, motion.proved};
}

template <>
struct Fields<ServoMotion>
    : Members<&ServoMotion::velocity, &ServoMotion::scale, &ServoMotion::limit, &ServoMotion::joint,
              &ServoMotion::bodies, &ServoMotion::proved> {
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
              &TrackerStep::limit, &TrackerStep::joint, &TrackerStep::assumed, &TrackerStep::bodies,
              &TrackerStep::proved> {};

}  // namespace beeline::python
