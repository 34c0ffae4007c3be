#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/error.h>
#include <beeline/trajectory/internal/mean_derivative.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline::internal {

double mean_derivative(const Trajectory& trajectory, std::size_t k, int coordinate, int order) {
  // Relative rounding error of a position, including the rounding in the file that it was read
  // from, with a margin.
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  if (order < 1 || order > 3) {
    throw Error("the order of a derivative must be 1, 2 or 3, not " + std::to_string(order));
  }
  const auto count = static_cast<std::size_t>(order);
  if (k + count >= trajectory.size()) return 0;
  double table[4] = {}, error = 0, factorial = 1;
  for (std::size_t j = 0; j <= count; ++j) {
    table[j] = trajectory.positions[k + j][coordinate];
    error = std::max(error, rounding * std::abs(table[j]));
  }
  for (std::size_t level = 1; level <= count; ++level) {
    factorial *= static_cast<double>(level);
    double shortest = Limits::none;
    for (std::size_t j = 0; j + level <= count; ++j) {
      const double h = trajectory.times[k + j + level] - trajectory.times[k + j];
      table[j] = (table[j + 1] - table[j]) / h;
      shortest = std::min(shortest, h);
    }
    error = 2 * error / shortest;
  }
  return std::max(0.0, std::abs(table[0]) - error) * factorial;
}

double needed_derivative(const Trajectory& trajectory, std::size_t k, int coordinate, int order) {
  const double mean = mean_derivative(trajectory, k, coordinate, order);
  if (order != 2 || !trajectory.velocities.empty() || k + 2 >= trajectory.size()) return mean;
  const auto q = [&](std::size_t sample) { return trajectory.positions[sample][coordinate]; };
  const double before = trajectory.times[k + 1] - trajectory.times[k];
  const double after = trajectory.times[k + 2] - trajectory.times[k + 1];
  const double shorter = std::min(before, after);
  const double change = std::abs((q(k + 2) - q(k + 1)) / after - (q(k + 1) - q(k)) / before);
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  return std::max(mean, (change - rounding * std::abs(q(k + 1)) / shorter) / (2 * shorter));
}

void check_fits(const Arm& arm, const Trajectory& trajectory) {
  check_trajectory(trajectory);
  if (trajectory.joint_names.size() == static_cast<std::size_t>(arm.dof())) return;
  throw Error("the trajectory has " + std::to_string(trajectory.joint_names.size()) +
              " joints, and arm " + arm.name() + " has " + std::to_string(arm.dof()));
}

}  // namespace beeline::internal
