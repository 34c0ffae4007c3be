#include <cmath>

#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {

double round_to_nanoseconds(double t) { return std::round(t * 1e9) / 1e9; }

void append(Trajectory& trajectory, const Trajectory& next) {
  const bool first = trajectory.times.empty();
  const double shift = first || next.times.empty() ? 0 : trajectory.times.back() - next.times[0];
  for (std::size_t k = first ? 0 : 1; k < next.size(); ++k) {
    trajectory.times.push_back(shift + next.times[k]);
    trajectory.positions.push_back(next.positions[k]);
    if (!next.velocities.empty()) trajectory.velocities.push_back(next.velocities[k]);
    if (!next.accelerations.empty()) trajectory.accelerations.push_back(next.accelerations[k]);
  }
}

void round_times(Trajectory& trajectory) {
  for (double& t : trajectory.times) t = round_to_nanoseconds(t);
}

}  // namespace beeline::internal
