#include <beeline/trajectory/internal/end_velocity.h>

namespace beeline::internal {

EndVelocity end_velocity(const Trajectory& trajectory, int coordinate, const Limits& limits,
                         TrajectoryEnd end) {
  constexpr double rest_fraction = 1e-4;  // of a velocity limit: slower is at rest
  EndVelocity result{0, rest_fraction * limits.velocity};
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
  result.allowed += 2 * limits.acceleration * h;
  return result;
}

}  // namespace beeline::internal
