#pragma once

#include <beeline/timing/point_to_point.h>

namespace beeline::internal {

/// Returns the state at a time in the first half, from 0 to duration / 2; the second half is its
/// point reflection. The phases after the constant acceleration are evaluated backward from the end
/// of the ramp and from the middle, so that both halves meet there exactly. Inlined, because a call
/// takes a third longer.
[[gnu::always_inline]] inline JointState first_half_state(const SCurve& curve, double t) {
  const double v = curve.velocity, a = curve.acceleration, j = curve.jerk;
  const double tj = curve.jerk_time, ramp = 2 * tj + curve.acceleration_time;
  // The state at `dt` seconds, of either sign, from a known one, at constant jerk.
  const auto from_state = [](double q0, double v0, double a0, double j0, double dt) {
    return JointState{q0 + dt * (v0 + dt * (a0 / 2 + dt * j0 / 6)), v0 + dt * (a0 + dt * j0 / 2),
                      a0 + dt * j0, j0};
  };
  if (t < tj) return from_state(0, 0, 0, j, t);
  if (t < ramp - tj) return from_state(a * tj * tj / 6, a * tj / 2, a, 0, t - tj);
  if (t < ramp) return from_state((curve.distance - v * curve.cruise_time) / 2, v, 0, -j, t - ramp);
  return from_state(curve.distance / 2, v, 0, 0, t - curve.duration / 2);
}

}  // namespace beeline::internal
