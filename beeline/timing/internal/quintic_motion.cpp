#include <algorithm>
#include <cmath>

#include <beeline/math/hermite.h>
#include <beeline/timing/internal/quintic_motion.h>

namespace beeline::internal {

QuinticMotion::QuinticMotion(const JointPath& path, const PathLimits& limits,
                             const TimeScaling& quintic)
    : path_(path),
      limits_(limits),
      derivatives_(path),
      times_(quintic.t),
      sample_(derivatives_.joints()) {}

JointState QuinticMotion::along(double tau) const {
  const double length = path_.s.back() - path_.s.front(), rate = 1 / duration();
  const RestToRest motion = rest_to_rest(tau / duration());
  return {path_.s.front() + length * motion.value, length * rate * motion.first,
          length * rate * rate * motion.second, length * rate * rate * rate * motion.third};
}

const MotionSample& QuinticMotion::at(double tau) {
  while (step_ + 2 < path_.size() && times_[step_ + 1] <= tau) ++step_;
  while (step_ > 0 && times_[step_] > tau) --step_;
  const double begin = path_.s[step_], length = path_.s[step_ + 1] - begin;
  const auto [s, v, a, j] = along(tau);
  double* const dq = sample_.half_velocity.data();
  double* const ddq = sample_.acceleration.data();
  double* const dddq = sample_.jerk.data();
  const double u = std::clamp((s - begin) / length, 0.0, 1.0);
  derivatives_.at(step_, u, dq, ddq, dddq);
  double fraction = 0;  // of a velocity limit
  const double usable = limits_.fraction.empty()
                            ? 1
                            : std::lerp(limits_.fraction[step_], limits_.fraction[step_ + 1], u);
  for (std::size_t i = 0; i < derivatives_.joints(); ++i) {
    fraction =
        std::max(fraction, std::abs(dq[i] * v) / limits_.velocity[static_cast<Eigen::Index>(i)]);
    dddq[i] = (dq[i] * j + v * (3 * ddq[i] * a + v * v * dddq[i])) / usable;
    ddq[i] = (dq[i] * a + ddq[i] * v * v) / usable;
    dq[i] *= 0.5 * v / usable;
  }
  if (!limits_.speed.empty()) {
    const double limit = std::lerp(limits_.speed[step_], limits_.speed[step_ + 1], u);
    fraction = std::max(fraction, v / limit);
  }
  sample_.inverse_max = fraction * fraction;
  return sample_;
}

std::vector<double> QuinticMotion::jerk_jumps() const {
  constexpr double rounding = 1e-13;  // of q, in the third differences
  const std::size_t joints = derivatives_.joints();
  std::vector<double> before(joints), after(joints), other(2 * joints);
  std::vector<double> all(path_.size(), 0);
  const double speed = along(0.5 * duration()).velocity;
  for (std::size_t k = 1; k + 1 < path_.size(); ++k) {
    derivatives_.at(k - 1, 1, other.data(), other.data() + joints, before.data());
    derivatives_.at(k, 0, other.data(), other.data() + joints, after.data());
    const double h = std::min(path_.s[k] - path_.s[k - 1], path_.s[k + 1] - path_.s[k]);
    for (std::size_t i = 0; i < joints; ++i) {
      const auto joint = static_cast<Eigen::Index>(i);
      const double noise = rounding * (1 + std::abs(path_.q[k][joint])) / (h * h * h);
      const double jump = std::abs(after[i] - before[i]) - noise;
      all[k] = std::max(all[k], jump * speed * speed * speed / limits_.jerk[joint]);
    }
  }
  return all;
}

}  // namespace beeline::internal
