#pragma once

#include <beeline/error.h>
#include <beeline/model/joint.h>

namespace beeline {

/// The minimum-time motion of one joint from rest to rest under limits on velocity, acceleration
/// and jerk (Biagiotti and Melchiorri, *Trajectory Planning for Automatic Machines and Robots*,
/// section 3.4). Seven phases of constant jerk: +j, 0, -j; cruise; -j, 0, +j. A phase that is not
/// needed lasts zero seconds. Velocity, acceleration and jerk are the largest that are reached,
/// with the sign of the distance; the acceleration is infinite where the velocity jumps, the jerk
/// where the acceleration jumps.
struct SCurve {
  double distance = 0;           ///< radians or metres, of either sign
  double duration = 0;           ///< seconds: 4 jerk_time + 2 acceleration_time + cruise_time
  double jerk_time = 0;          ///< of each of the four phases of constant nonzero jerk
  double acceleration_time = 0;  ///< of each of the two phases of constant nonzero acceleration
  double cruise_time = 0;        ///< at constant velocity
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
};

/// The state of a joint along its motion.
struct JointState {
  double position = 0;  ///< relative to the start
  double velocity = 0;
  double acceleration = 0;
  double jerk = 0;
};

/// Minimises the duration over `distance` subject to |v| <= velocity, |a| <= acceleration, |j| <=
/// jerk, in closed form. Any limit may be infinite: without a jerk limit the velocity is a
/// trapezoid, without an acceleration limit as well it is a step. Position limits are ignored.
/// Throws Error when the distance is not finite, a limit is not above zero, all three are infinite,
/// or the duration is too large for a double.
SCurve s_curve(double distance, const Limits& limits);

/// Returns the same motion with the given duration: all phases are scaled alike, so limits that
/// were kept are still kept. Throws Error when the duration is shorter than the curve's own, or not
/// finite.
SCurve stretched(const SCurve& curve, double duration);

/// The state at time t. At rest until 0 and from the duration on, at position 0 and at exactly
/// `distance`. Throws Error when t is NaN.
JointState at(const SCurve& curve, double t);

}  // namespace beeline
