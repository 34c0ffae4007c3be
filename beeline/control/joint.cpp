#include <algorithm>
#include <cmath>

#include <beeline/control/internal/simulate.h>
#include <beeline/control/joint.h>
#include <beeline/error.h>

namespace beeline {
using namespace internal;
namespace {

// Radians or metres. A joint that starts this near its goal has no overshoot, since the ratio would
// be rounding.
constexpr double at_goal = 1e-9;

}  // namespace

double joint_overshoot(std::span<const Configuration> samples, const Configuration& goal) {
  double largest = 0;
  const Configuration distance = goal - samples.front();
  for (const Configuration& q : samples) {
    for (Eigen::Index k = 0; k < distance.size(); ++k) {
      if (std::abs(distance[k]) > at_goal)
        largest = std::max(largest, (q[k] - goal[k]) / distance[k]);
    }
  }
  return largest;
}

ControlledMotion control_joints(const Arm& arm, const Configuration& start,
                                const Configuration& goal, const PidGains& gains,
                                const SimulationOptions& options) {
  check_options(options);
  check_configuration(arm, goal);
  Pid pid(gains, goal);
  ControlledMotion motion = begin_motion(arm, start);
  motion.error = (goal - start).lpNorm<Eigen::Infinity>();
  const auto outside = limit_violations(arm, goal);
  if (!outside.empty()) {
    motion.status = MotionStatus::outside_limits;
    motion.reason = "the goal is outside the limits: " + outside.front();
    return motion;
  }
  pid.start(start);
  const ControlLaw law{
      [&goal](const Configuration& q) { return (goal - q).lpNorm<Eigen::Infinity>(); },
      [&pid](const Configuration& q) { return pid.step(q); }};
  if (simulate(arm, law, options, motion)) motion.arrivals = {motion.trajectory.size() - 1};
  if (motion.status == MotionStatus::outside_limits) {  // from overshoot, as the limits are convex
    motion.reason += "; the controller overshoots: the gains are too large";
  }
  if (motion.status == MotionStatus::cancelled) return motion;
  motion.overshoot = joint_overshoot(motion.trajectory.positions, goal);
  return motion;
}

}  // namespace beeline
