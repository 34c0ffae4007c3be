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

/// Returns the velocity nearest to `velocity` within the bounds of this step, `change` being the
/// largest change of the last velocity. If both exclude each other, the velocity is within `change`
/// of the last one.
double velocity_within(const VelocityBounds& bounds, double velocity, double last, double change);

/// The joint velocities that the limits of the joints allow in one step.
struct VelocityBox {
  Eigen::VectorXd lower, upper;  ///< rad/s or m/s
};

/// Sets the box to the ends of velocity_within() for each coordinate. Does not allocate if the box
/// has its size.
void fill_velocity_box(const Arm& arm, const std::vector<VelocityBounds>& bounds,
                       const Eigen::VectorXd& last, double time_step, VelocityBox& box);

/// Returns the largest speed v at which a coordinate can stop within `distance`, if it continues
/// for one time step h and then brakes with acceleration a: v h + v^2 / (2 a) = distance. Without
/// an acceleration limit v = distance / h.
double max_stopping_speed(double distance, double acceleration, double time_step);

/// Computes the bounds of every coordinate at q. A coordinate outside its position bounds can only
/// move back towards them.
void fill_velocity_bounds(const Arm& arm, const Bounds& positions, const ConfigurationRef& q,
                          double time_step, std::vector<VelocityBounds>& bounds);

}  // namespace beeline::internal
