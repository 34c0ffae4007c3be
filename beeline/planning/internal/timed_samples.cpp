#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/chord_bound.h>
#include <beeline/certificate/joint_faults.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/timed_samples.h>

namespace beeline {
namespace {

/// Of a retimed motion, the samples that were asked for: they are all there, in order.
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

}  // namespace

std::string append_timed(Trajectory& trajectory, const Arm& arm,
                         std::span<const Configuration> samples, const RetimeOptions& options,
                         const std::function<void(Trajectory&, std::span<const double>)>& brought) {
  constexpr int max_attempts = 8;     // to find how much slower samples at a rate have to be
  constexpr double rounding = 1e-11;  // what retime() does not take for a motion is a tenth of it
  const bool moves = std::any_of(samples.begin(), samples.end(), [&](const Configuration& q) {
    return (q - samples.front()).lpNorm<Eigen::Infinity>() > rounding;
  });
  if (!moves) return {};
  Trajectory way{arm.joint_names(), {}, {samples.begin(), samples.end()}, {}, {}};
  for (std::size_t k = 0; k < samples.size(); ++k) way.times.push_back(static_cast<double>(k));
  RetimeOptions retiming = options;
  retiming.fewest_steps = 0;  // what is left of the way is proved
  const bool paced = std::isfinite(options.tool_speed);
  Trajectory motion;
  for (int left = max_attempts; left > 0; --left) {
    const Retimed timed = retime(arm, way, retiming);
    if (!timed.found()) return timed.reason;
    motion = options.rate > 0 ? timed.trajectory : only_samples(timed.trajectory, samples);
    if (options.rate > 0 && brought) brought(motion, timed.ways);
    const double slower = std::max(paced ? largest_tool_speed(arm, motion) / options.tool_speed : 1,
                                   slowdown_for_limits(arm, motion, keeps_jerk(timed.profile)));
    if (options.rate > 0 && slower > 1 && left > 1) {  // so that the samples keep the rate
      retiming.speed_limit /= slower * (1 + 1e-3);
      if (paced) retiming.tool_speed /= slower * (1 + 1e-3);
      continue;
    }
    slow_down(motion, slower);
    break;
  }
  append(trajectory, motion);
  return {};
}

void slow_down(Trajectory& motion, double factor) {
  if (!(factor > 1)) return;
  for (double& t : motion.times) t *= factor;
  for (Configuration& v : motion.velocities) v /= factor;
  for (Configuration& a : motion.accelerations) a /= factor * factor;
}

// Its velocity differs from the mean by half its largest change, which is 4 times what leaves the
// chord.
double largest_tool_speed(const Arm& arm, const Trajectory& motion) {
  double largest = 0;
  Vector3 before = forward_kinematics(arm, motion.positions.front()).translation();
  for (std::size_t k = 1; k < motion.size(); ++k) {
    const Vector3 now = forward_kinematics(arm, motion.positions[k]).translation();
    const ChordBound step = chord_bound(arm, motion.positions[k - 1], motion.positions[k]);
    const double dt = motion.times[k] - motion.times[k - 1];
    largest = std::max(largest, ((now - before).norm() + 4 * step.position) / dt);
    before = now;
  }
  return largest;
}

void append(Trajectory& trajectory, const Trajectory& motion) {
  const double start = trajectory.times.back();
  for (std::size_t k = 1; k < motion.size(); ++k) {
    trajectory.times.push_back(start + motion.times[k]);
    trajectory.positions.push_back(motion.positions[k]);
    trajectory.velocities.push_back(motion.velocities[k]);
    trajectory.accelerations.push_back(motion.accelerations[k]);
  }
}

}  // namespace beeline
