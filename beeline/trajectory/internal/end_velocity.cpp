#include <cmath>

#include <beeline/trajectory/internal/end_velocity.h>

namespace beeline::internal {

double rest_velocity(const Trajectory& trajectory, const Limits& limits, double h) {
  constexpr double rest_fraction = 1e-4;  // of a velocity limit: slower is at rest
  const double change = trajectory.velocities.empty() ? 2 * limits.acceleration * h : 0;
  return rest_fraction * limits.velocity + change;
}

bool counts_as_rest(const Trajectory& trajectory, const std::vector<Limits>& limits,
                    const Configuration& velocity, double h) {
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const double speed = std::abs(velocity[static_cast<Eigen::Index>(i)]);
    if (!(speed <= rest_velocity(trajectory, limits[i], h))) return false;
  }
  return true;
}

EndVelocity end_velocity(const Trajectory& trajectory, int coordinate, const Limits& limits,
                         TrajectoryEnd end) {
  EndVelocity result{0, rest_velocity(trajectory, limits, 0)};
  const std::size_t size = trajectory.size();
  if (size < 2) return result;
  const bool first = end == TrajectoryEnd::first;
  if (!trajectory.velocities.empty()) {
    result.velocity =
        (first ? trajectory.velocities.front() : trajectory.velocities.back())[coordinate];
    return result;
  }
  const std::size_t k = first ? 0 : size - 2;
  const double h = trajectory.times[k + 1] - trajectory.times[k];
  result.velocity =
      (trajectory.positions[k + 1][coordinate] - trajectory.positions[k][coordinate]) / h;
  result.allowed = rest_velocity(trajectory, limits, h);
  return result;
}

}  // namespace beeline::internal
