#include <algorithm>
#include <cmath>

#include <beeline/timing/internal/quintic_motion.h>

namespace beeline {

QuinticMotion::QuinticMotion(const JointPath& path, const PathLimits& limits,
                             const TimeScaling& quintic)
    : path_(path), limits_(limits), rates_(path), times_(quintic.t), moment_(rates_.joints()) {}

JointState QuinticMotion::along(double t) const {
  const double length = path_.s.back() - path_.s.front(), pace = 1 / duration();
  const double u = t / duration(), rest = 1 - u;
  return {path_.s.front() + length * u * u * u * (10 + u * (-15 + 6 * u)),
          length * pace * 30 * u * u * rest * rest,
          length * pace * pace * 60 * u * rest * (rest - u),
          length * pace * pace * pace * 60 * (1 - 6 * u * rest)};
}

const MotionSample& QuinticMotion::at(double t) {
  while (step_ + 2 < path_.size() && times_[step_ + 1] <= t) ++step_;
  while (step_ > 0 && times_[step_] > t) --step_;
  const double begin = path_.s[step_], length = path_.s[step_ + 1] - begin;
  const auto [s, v, a, j] = along(t);
  double* const dq = moment_.half_velocity.data();
  double* const ddq = moment_.acceleration.data();
  double* const dddq = moment_.jerk.data();
  const double share = std::clamp((s - begin) / length, 0.0, 1.0);
  rates_.at(step_, share, dq, ddq, dddq);
  double most = 0;  // share of a limit of velocity
  for (std::size_t i = 0; i < rates_.joints(); ++i) {
    most = std::max(most, std::abs(dq[i] * v) / limits_.velocity[static_cast<Eigen::Index>(i)]);
    dddq[i] = dq[i] * j + v * (3 * ddq[i] * a + v * v * dddq[i]);
    ddq[i] = dq[i] * a + ddq[i] * v * v;
    dq[i] *= 0.5 * v;
  }
  if (!limits_.speed.empty()) {
    most = std::max(most, v / std::lerp(limits_.speed[step_], limits_.speed[step_ + 1], share));
  }
  moment_.inverse_most = most * most;
  return moment_;
}

std::vector<double> QuinticMotion::jumps() const {
  constexpr double rounding = 1e-13;  // of q, in the differences that q''' is made of
  const std::size_t joints = rates_.joints();
  std::vector<double> before(joints), after(joints), other(2 * joints);
  std::vector<double> all(path_.size(), 0);
  const double speed = along(0.5 * duration()).velocity;
  for (std::size_t k = 1; k + 1 < path_.size(); ++k) {
    rates_.at(k - 1, 1, other.data(), other.data() + joints, before.data());
    rates_.at(k, 0, other.data(), other.data() + joints, after.data());
    const double h = std::min(path_.s[k] - path_.s[k - 1], path_.s[k + 1] - path_.s[k]);
    for (std::size_t i = 0; i < joints; ++i) {
      const auto joint = static_cast<Eigen::Index>(i);
      const double lost = rounding * (1 + std::abs(path_.q[k][joint])) / (h * h * h);
      const double jump = std::abs(after[i] - before[i]) - lost;
      all[k] = std::max(all[k], jump * speed * speed * speed / limits_.jerk[joint]);
    }
  }
  return all;
}

}  // namespace beeline
