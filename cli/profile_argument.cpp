#include "profile_argument.h"

namespace beeline::command {

Option ProfileArgument::option(const std::vector<std::string>& methods) {
  return Option(
      "--profile PROFILE",
      "Time profile. jerk: short time under velocity, acceleration and jerk limits; fastest: "
      "minimum time under velocity and acceleration limits; quintic, s-curve, trapezoidal: one "
      "profile of that form from stop to stop. Every profile keeps jerk limits that are known; "
      "fastest and trapezoidal leave jerk free only where it would be assumed. Default: " +
          name(default_profile) + ".",
      &text, {.choices = profile_names(), .methods = methods});
}

Option InterpolationArgument::option(const std::vector<std::string>& methods) {
  return Option("--interpolation KIND",
                "The motion between two samples, which is what is proved and what a joint "
                "trajectory controller plays: linear (positions are written), cubic (velocities "
                "too), quintic (accelerations too).",
                &text, {.choices = interpolation_names(), .methods = methods});
}

std::optional<Profile> ProfileArgument::read() const {
  if (text.empty()) return std::nullopt;
  return profile_named(text);
}

}  // namespace beeline::command
