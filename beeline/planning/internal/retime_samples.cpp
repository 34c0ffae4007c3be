#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/chord_bound.h>
#include <beeline/certificate/internal/mean_derivative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/retime_samples.h>

namespace beeline::internal {
namespace {

/// Returns the given samples of a retimed motion, which contains them in order and others between
/// them.
Trajectory only_samples(const Trajectory& timed, std::span<const Configuration> samples) {
  Trajectory kept{timed.joint_names, {}, {}, {}, {}};
  std::size_t next = 0;
  for (std::size_t k = 0; k < timed.size() && next < samples.size(); ++k) {
    if (timed.positions[k] != samples[next]) continue;
    kept.times.push_back(timed.times[k]);
    kept.positions.push_back(timed.positions[k]);
    kept.velocities.push_back(timed.velocities[k]);
    kept.accelerations.push_back(timed.accelerations[k]);
    do ++next;
    while (next < samples.size() && samples[next] == samples[next - 1]);
  }
  return kept;
}

/// Bounds the speed of the tool's origin, the joints moving linearly between samples: metres per
/// second. Over a step the velocity differs from its mean by at most half of max |p''|, which is 4
/// times ChordBound::position.
double largest_tool_speed(const Arm& arm, const Trajectory& motion) {
  double largest = 0;
  Vector3 before = forward_kinematics(arm, motion.positions.front()).translation();
  for (std::size_t k = 1; k < motion.size(); ++k) {
    const Vector3 here = forward_kinematics(arm, motion.positions[k]).translation();
    const ChordBound step = chord_bound(arm, motion.positions[k - 1], motion.positions[k]);
    const double dt = motion.times[k] - motion.times[k - 1];
    largest = std::max(largest, ((here - before).norm() + 4 * step.position) / dt);
    before = here;
  }
  return largest;
}

/// Appends a motion that begins where the trajectory ends.
void append(Trajectory& trajectory, const Trajectory& motion) {
  const double start = trajectory.times.back();
  for (std::size_t k = 1; k < motion.size(); ++k) {
    trajectory.times.push_back(start + motion.times[k]);
    trajectory.positions.push_back(motion.positions[k]);
    trajectory.velocities.push_back(motion.velocities[k]);
    trajectory.accelerations.push_back(motion.accelerations[k]);
  }
}

}  // namespace

std::string append_retimed(const Arm& arm, Trajectory& trajectory,
                           std::span<const Configuration> samples, const RetimeOptions& options,
                           const MoveSamples& move) {
  constexpr int max_attempts = 8;  // two suffice, unless moved samples change their speed
  constexpr double excess = 1e-3;  // of each slowdown, so that the attempts end
  constexpr double still = 1e-11;  // radians or metres; retime() ignores a tenth of it
  const bool moves = std::any_of(samples.begin(), samples.end(), [&](const Configuration& q) {
    return (q - samples.front()).lpNorm<Eigen::Infinity>() > still;
  });
  if (!moves) return {};
  Trajectory untimed{arm.joint_names(), {}, {samples.begin(), samples.end()}, {}, {}};
  for (std::size_t k = 0; k < samples.size(); ++k) untimed.times.push_back(static_cast<double>(k));
  RetimeOptions retiming = options;
  retiming.min_steps = 0;  // path_deviation() refuses a motion with too few samples
  const bool speed_limited = std::isfinite(options.tool_speed);
  Trajectory motion;
  for (int left = max_attempts; left > 0; --left) {
    const Retimed timed = retime(arm, untimed, retiming);
    if (!timed) return timed.reason;
    motion = options.rate > 0 ? timed.trajectory : only_samples(timed.trajectory, samples);
    if (options.rate > 0 && move) move(motion, timed.arc_lengths);
    const double factor =
        std::max(speed_limited ? largest_tool_speed(arm, motion) / options.tool_speed : 1,
                 slowdown_for_limits(arm, motion, keeps_jerk(timed.profile)));
    if (options.rate > 0 && factor > 1 && left > 1) {  // stretching would change the rate
      retiming.speed_scale /= factor * (1 + excess);
      if (speed_limited) retiming.tool_speed /= factor * (1 + excess);
      continue;
    }
    slow_down(motion, factor);
    break;
  }
  append(trajectory, motion);
  return {};
}

}  // namespace beeline::internal
