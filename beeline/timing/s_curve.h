#pragma once

#include <beeline/model/joint.h>

namespace beeline {

/// The quickest motion of one joint from rest to rest within limits on velocity, acceleration and
/// jerk: jerk, constant acceleration, jerk back; cruise; and the same mirrored in time. A phase
/// that is not needed lasts zero seconds. Velocity, acceleration and jerk are the largest that are
/// reached, with the sign of the distance. The acceleration is infinite where the velocity jumps,
/// the jerk where the acceleration jumps.
struct SCurve {
  double distance = 0;           ///< radians or metres, of either sign
  double duration = 0;           ///< seconds: 4 jerk_time + 2 acceleration_time + cruise_time
  double jerk_time = 0;          ///< of each of the four phases of constant jerk
  double acceleration_time = 0;  ///< of each of the two phases of constant acceleration
  double cruise_time = 0;        ///< at constant velocity
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
};

/// Where a joint is on its way, and how it moves there.
struct JointState {
  double position = 0;  ///< from where it began
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
};

/// The time-optimal curve over `distance`, in closed form. Any limits may be infinite: without one
/// on jerk the velocity is a trapezoid, without one on acceleration either a step. The limits on
/// position play no part.
/// Throws Error when the distance is not finite, a limit is not above zero, velocity, acceleration
/// and jerk are all without limit, or the motion would take longer than a number can tell.
SCurve s_curve(double distance, const Limits& limits);

/// The same way in `duration` seconds: all phases longer in proportion, so that what kept its
/// limits keeps them. Throws Error when the duration is shorter than the curve's own, or not
/// finite.
SCurve stretched(const SCurve& curve, double duration);

/// The state at time t; at rest until 0 and from the duration on, at exactly 0 and the distance.
/// Throws Error when t is no number.
JointState at(const SCurve& curve, double t);

/// The state at a time in the first half, from 0 to duration / 2. The second half is the first one
/// run backwards from the other end. What comes after the constant acceleration is told from the
/// end of the ramp and from the middle, so that the halves meet there.
inline JointState before_the_middle(const SCurve& curve, double t) {
  const double v = curve.velocity, a = curve.acceleration, j = curve.jerk;
  const double tj = curve.jerk_time, ramp = 2 * tj + curve.acceleration_time;
  // `since` a known state (or till then, if it is negative) the jerk is constant.
  const auto carried_on = [](double q0, double v0, double a0, double j0, double since) {
    return JointState{q0 + since * (v0 + since * (a0 / 2 + since * j0 / 6)),
                      v0 + since * (a0 + since * j0 / 2), a0 + since * j0, j0};
  };
  if (t < tj) return carried_on(0, 0, 0, j, t);
  if (t < ramp - tj) return carried_on(a * tj * tj / 6, a * tj / 2, a, 0, t - tj);
  if (t < ramp) return carried_on((curve.distance - v * curve.cruise_time) / 2, v, 0, -j, t - ramp);
  return carried_on(curve.distance / 2, v, 0, 0, t - curve.duration / 2);
}

}  // namespace beeline
