#include <algorithm>
#include <cmath>

#include <beeline/control/joint.h>
#include <beeline/error.h>

namespace beeline {
namespace {

constexpr double no_way = 1e-9;  // a joint that starts this near to its goal cannot overshoot

void check_gains(const PidGains& gains) {
  if (!(gains.kp > 0) || !std::isfinite(gains.kp)) {
    throw Error("the gain kp must be above zero, not " + number(gains.kp));
  }
  for (const double gain : {gains.ki, gains.kd}) {
    if (!(gain >= 0) || !std::isfinite(gain)) {
      throw Error("the gains ki and kd must be zero or more, not " + number(gain));
    }
  }
}

/// The law's memory: the sum of the errors and the error before.
class Pid {
 public:
  Pid(const PidGains& gains, const Configuration& goal, const Configuration& start)
      : gains_(gains), goal_(goal), sum_(Configuration::Zero(goal.size())), before_(goal - start) {}

  Configuration step(const Configuration& q) {
    const Configuration e = goal_ - q;
    sum_ += e;
    const Configuration change = e - before_;
    before_ = e;
    return gains_.kp * e + gains_.ki * sum_ + gains_.kd * change;
  }

 private:
  PidGains gains_;
  Configuration goal_, sum_, before_;
};

}  // namespace

double joint_overshoot(std::span<const Configuration> samples, const Configuration& goal) {
  double largest = 0;
  const Configuration way = goal - samples.front();
  for (const Configuration& q : samples) {
    for (Eigen::Index k = 0; k < way.size(); ++k) {
      if (std::abs(way[k]) > no_way) largest = std::max(largest, (q[k] - goal[k]) / way[k]);
    }
  }
  return largest;
}

ControlledMotion control_joints(const Arm& arm, const Configuration& start,
                                const Configuration& goal, const PidGains& gains,
                                const SimulationOptions& options) {
  check_options(options);
  check_gains(gains);
  check_configuration(arm, goal);
  ControlledMotion motion = begin_motion(arm, start);
  motion.error = (goal - start).lpNorm<Eigen::Infinity>();
  const auto outside = limit_violations(arm, goal);
  if (!outside.empty()) {
    motion.status = MotionStatus::outside_limits;
    motion.reason = "the goal cannot be kept: " + outside.front();
    return motion;
  }
  Pid pid(gains, goal, start);
  const ControlLaw law{
      [&goal](const Configuration& q) { return (goal - q).lpNorm<Eigen::Infinity>(); },
      [&pid](const Configuration& q) { return pid.step(q); }};
  if (simulate(arm, law, options, motion)) motion.arrivals = {motion.trajectory.size() - 1};
  if (motion.status == MotionStatus::outside_limits) {  // the box of the limits is convex
    motion.reason += "; it went beyond the goal: the gains are too large";
  }
  motion.overshoot = joint_overshoot(motion.trajectory.positions, goal);
  return motion;
}

}  // namespace beeline
