#pragma once

#include <vector>

#include <beeline/control/servo.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// The interval of a coordinate's velocity that the limits allow in one step. It contains 0.
struct VelocityBounds {
  double lower = 0, upper = 0;  ///< rad/s or m/s
  /// The limit that determines each end: `position` when stopping before the position limit
  /// requires less than the velocity limit.
  ServoLimit lower_limit = ServoLimit::velocity, upper_limit = ServoLimit::velocity;

  /// Returns the largest speed in the direction of `velocity`.
  double max_speed(double velocity) const { return velocity > 0 ? upper : -lower; }
  ServoLimit limit(double velocity) const { return velocity > 0 ? upper_limit : lower_limit; }
};

/// Returns the largest speed v at which a coordinate can stop within `distance`, if it continues
/// for one time step h and then brakes with acceleration a: v h + v^2 / (2 a) = distance. Without
/// an acceleration limit v = distance / h.
double max_stopping_speed(double distance, double acceleration, double time_step);

/// Computes the bounds of every coordinate at q. A coordinate outside its position bounds can only
/// move back towards them.
void fill_velocity_bounds(const Arm& arm, const Bounds& positions, const ConfigurationRef& q,
                          double time_step, std::vector<VelocityBounds>& bounds);

}  // namespace beeline::internal
