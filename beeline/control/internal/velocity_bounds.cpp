#include <algorithm>
#include <cmath>

#include <beeline/control/internal/velocity_bounds.h>

namespace beeline::internal {

double velocity_within(const VelocityBounds& bounds, double velocity, double last, double change) {
  return std::clamp(std::clamp(velocity, bounds.lower, bounds.upper), last - change, last + change);
}

void fill_velocity_box(const Arm& arm, const std::vector<VelocityBounds>& bounds,
                       const Eigen::VectorXd& last, double time_step, VelocityBox& box) {
  for (Eigen::Index k = 0; k < last.size(); ++k) {
    const double change = arm.limits(k).acceleration * time_step;
    box.lower[k] = velocity_within(bounds[k], -Limits::none, last[k], change);
    box.upper[k] = velocity_within(bounds[k], Limits::none, last[k], change);
  }
}

double max_stopping_speed(double distance, double acceleration, double time_step) {
  if (!(distance > 0)) return 0;
  if (!std::isfinite(acceleration) || !std::isfinite(distance)) return distance / time_step;
  // The positive root of the quadratic equation, computed without cancellation.
  return 2 * distance /
         (time_step + std::sqrt(time_step * time_step + 2 * distance / acceleration));
}

void fill_velocity_bounds(const Arm& arm, const Bounds& positions, const ConfigurationRef& q,
                          double time_step, std::vector<VelocityBounds>& bounds) {
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const Limits& limits = arm.limits(k);
    const double up = max_stopping_speed(positions.upper[k] - q[k], limits.acceleration, time_step);
    const double down =
        max_stopping_speed(q[k] - positions.lower[k], limits.acceleration, time_step);
    const auto limit = [&limits](double stopping_speed) {
      return stopping_speed < limits.velocity ? ServoLimit::position : ServoLimit::velocity;
    };
    bounds[k] = {-std::min(limits.velocity, down), std::min(limits.velocity, up), limit(down),
                 limit(up)};
  }
}

}  // namespace beeline::internal
