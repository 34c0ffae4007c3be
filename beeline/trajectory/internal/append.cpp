#include <cmath>

#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {

double round_to_nanoseconds(double t) { return std::round(t * 1e9) / 1e9; }

void append_sample(Trajectory& trajectory, const Trajectory& from, std::size_t k, double t) {
  trajectory.times.push_back(t);
  trajectory.positions.push_back(from.positions[k]);
  if (!from.velocities.empty()) trajectory.velocities.push_back(from.velocities[k]);
  if (!from.accelerations.empty()) trajectory.accelerations.push_back(from.accelerations[k]);
}

void append(Trajectory& trajectory, const Trajectory& next) {
  const bool first = trajectory.times.empty();
  const double shift = first || next.times.empty() ? 0 : trajectory.times.back() - next.times[0];
  for (std::size_t k = first ? 0 : 1; k < next.size(); ++k) {
    append_sample(trajectory, next, k, shift + next.times[k]);
  }
}

Trajectory samples_between(const Trajectory& trajectory, std::size_t first, std::size_t last) {
  Trajectory part{trajectory.joint_names, {}, {}, {}, {}};
  for (std::size_t k = first; k <= last; ++k)
    append_sample(part, trajectory, k, trajectory.times[k]);
  return part;
}

void round_times(Trajectory& trajectory) {
  for (double& t : trajectory.times) t = round_to_nanoseconds(t);
}

}  // namespace beeline::internal
