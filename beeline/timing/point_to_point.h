#pragma once

#include <span>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/model/joint.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The minimum-time motion of one joint from rest to rest under limits on velocity, acceleration
/// and jerk (Biagiotti and Melchiorri, *Trajectory Planning for Automatic Machines and Robots*,
/// section 3.4). Seven phases of constant jerk: +j, 0, -j; cruise; -j, 0, +j. A phase that is not
/// needed lasts zero seconds.
struct SCurve {
  double distance = 0;   ///< distance with its sign, rad or m
  double duration = 0;   ///< duration, s: 4 jerk_time + 2 acceleration_time + cruise_time
  double jerk_time = 0;  ///< duration of each of the four phases of constant nonzero jerk, s
  /// Duration of each of the two phases of constant nonzero acceleration, s.
  double acceleration_time = 0;
  double cruise_time = 0;  ///< duration of the phase of constant velocity, s
  double velocity = 0;     ///< largest velocity, rad/s or m/s, with the sign of the distance
  /// Largest acceleration, rad/s^2 or m/s^2, with the sign of the distance; infinite if the
  /// velocity jumps.
  double acceleration = 0;
  /// Largest jerk, rad/s^3 or m/s^3, with the sign of the distance; infinite if the acceleration
  /// jumps.
  double jerk = 0;
};

/// The state of a joint along its motion.
struct JointState {
  double position = 0;      ///< relative to the start, rad or m
  double velocity = 0;      ///< rad/s or m/s
  double acceleration = 0;  ///< rad/s^2 or m/s^2
  double jerk = 0;          ///< rad/s^3 or m/s^3
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

/// The synchronisation of the faster joints with the slowest one.
enum class Synchronise {
  time,      ///< each joint has an s-curve of its own, stretched to the duration of the slowest
  straight,  ///< all joints have one s-curve in proportion: a straight line in joint space
};

struct PointToPointOptions {
  Synchronise synchronise = Synchronise::time;  ///< how the joints' times agree
  /// Whether to accept a start that is outside the position limits, by max_recover at most. Each
  /// joint moves in one direction only, so it moves back within them. Only for the limits of an
  /// arm.
  bool from_outside = false;
};

/// A motion of all joints from rest to rest, each along an s-curve.
struct PointToPoint {
  Configuration from;          ///< rad or m
  Configuration to;            ///< rad or m
  std::vector<SCurve> curves;  ///< one for each coordinate, all of the same duration
  double duration = 0;         ///< seconds
};

/// Minimises the duration of a motion from one configuration to another subject to the joints'
/// limits on velocity, acceleration and jerk. For Synchronise::time the duration is the minimum
/// time of the slowest joint. For Synchronise::straight it is at least as long, because each
/// joint's limits bind the common curve. Unknown limits count as assumed ones (motion_limits()).
/// Throws Error if a configuration does not fit the arm or is outside its limits (farther than
/// options.from_outside accepts), and if s_curve() throws.
PointToPoint point_to_point(const Arm& arm, const ConfigurationRef& from,
                            const ConfigurationRef& to, const PointToPointOptions& options = {});

/// The same into the caller's motion; does not allocate if `motion` already has this number of
/// joints.
void point_to_point(const Arm& arm, const ConfigurationRef& from, const ConfigurationRef& to,
                    PointToPoint& motion, const PointToPointOptions& options = {});

/// The same for joints with these limits, one for each coordinate of `from` and `to`. An infinite
/// velocity limit counts as assumed_velocity_limit; infinite acceleration and jerk limits do not
/// bind.
void point_to_point(std::span<const Limits> limits, const ConfigurationRef& from,
                    const ConfigurationRef& to, PointToPoint& motion,
                    const PointToPointOptions& options = {});

/// Writes the state at time t into buffers of one number per joint; does not allocate. It is
/// exactly `from` until 0, and `to` from the duration on. Throws Error when t is NaN or a buffer
/// has another size.
void at(const PointToPoint& motion, double t, Eigen::Ref<Configuration> q,
        Eigen::Ref<Configuration> velocity, Eigen::Ref<Configuration> acceleration);

/// Samples the motion at times k / rate, rounded to nanoseconds. The motion is slowed down to whole
/// periods plus one more, over which its accelerations are averaged, so that the quintics between
/// the samples are within the arm's limits (motion_limits()) at all times. The first sample is
/// exactly `from`, the last `to`. There is one sample if nothing moves, and none if the budget ends
/// the computation. A longer `duration`, in seconds, slows the motion down to it, in whole periods.
/// Throws Error when the rate is not above zero, the motion does not fit the arm, or there would be
/// more than ten million samples.
Trajectory sampled(const Arm& arm, const PointToPoint& motion, double rate,
                   const Budget& budget = {}, double duration = 0);

}  // namespace beeline
