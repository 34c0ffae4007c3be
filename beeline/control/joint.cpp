#include <algorithm>
#include <cmath>

#include <beeline/control/internal/simulate.h>
#include <beeline/control/joint.h>
#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/printed_motion.h>
#include <beeline/timing/internal/from_outside.h>
#include <beeline/trajectory/internal/given_duration.h>
#include <beeline/trajectory/internal/recovery.h>
#include <beeline/trajectory/internal/sample_rate.h>

namespace beeline {
using namespace internal;
namespace {

/// Throws Error for a duration that is not a whole number of periods.
void check_whole_periods(const JointMoveOptions& options) {
  constexpr double rounding = 1e-6;  // fraction of a period
  if (!options.duration) return;
  const double periods = *options.duration * options.rate;
  if (!std::isfinite(periods)) {
    throw Error::of("duration", "duration must be shorter at " + number(options.rate) +
                                    " samples per second, not " + number(*options.duration) + " s");
  }
  if (std::abs(periods - std::round(periods)) <= rounding * std::max(1.0, periods * 1e-6)) return;
  const double below = std::floor(periods) / options.rate;
  throw Error::of("duration",
                  "duration must be a whole number of periods at " + number(options.rate) +
                      " samples per second: " + (below > 0 ? number(below) + " or " : "") +
                      number(std::ceil(periods) / options.rate) + " s, not " +
                      number(*options.duration));
}

/// The motion from a start as far outside the limits as the options accept.
PointToPoint planned_move(const Arm& arm, const Configuration& start, const Configuration& goal,
                          const JointMoveOptions& options) {
  starts_outside(arm, start, options.recover, "from");
  return motion_from_outside(arm, start, goal, options.synchronise);
}

// Radians or metres. A joint that starts this near to its goal has no overshoot, because the ratio
// would be rounding.
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

ControlledMotion move_joints(const Arm& arm, const Configuration& start, const Configuration& goal,
                             const JointMoveOptions& options) {
  constexpr double rounding = 1e-9;  // seconds
  check_configuration(arm, start);
  check_configuration(arm, goal);
  check_rate(options.rate);
  check_duration(options.duration);
  check_whole_periods(options);
  ControlledMotion result;
  result.trajectory = at_rest(arm, start);
  const std::vector<Reason> outside = limit_violations(arm, goal);
  if (!outside.empty()) {
    result.error = (goal - start).lpNorm<Eigen::Infinity>();
    result.status = MotionStatus::outside_limits;
    result.reason = outside.front();
    result.reason.code = ReasonCode::goal_outside_limits;
    return result;
  }
  check_recover(options.recover);
  const PointToPoint motion = planned_move(arm, start, goal, options);
  BudgetMeter budget(options.budget);
  const double asked = options.duration.value_or(0);
  Trajectory samples = sampled(arm, motion, options.rate, budget.part(), asked);
  if (samples.size() > 0 && samples.times.back() > asked + rounding && options.duration) {
    samples = sampled(arm, motion, options.rate, budget.part());
    if (samples.size() > 0) {
      result.status = MotionStatus::outside_limits;
      result.reason = too_short(asked, samples.times.back());
      return result;
    }
  }
  if (samples.size() == 0) {
    set_ended(ReasonCode::ended_before_sampling, budget.ending(), result);
    return result;
  }
  result.trajectory = std::move(samples);
  result.recovery = recovery_of(arm, result.trajectory);
  result.arrivals = {result.trajectory.size() - 1};
  result.steps = static_cast<int>(result.trajectory.size()) - 1;
  set_limit_usage(arm, budget, result);
  return result;
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
    motion.reason = outside.front();
    motion.reason.code = ReasonCode::goal_outside_limits;
    return motion;
  }
  pid.start(start);
  const ControlLaw law{
      [&goal](const Configuration& q) { return (goal - q).lpNorm<Eigen::Infinity>(); },
      [&pid](const Configuration& q) { return pid.step(q); }};
  BudgetMeter budget(options.budget);
  SimulationOptions simulated = options;
  simulated.budget = budget.part();
  const bool reached = simulate(arm, law, simulated, motion);
  if (reached) motion.arrivals = {motion.trajectory.size() - 1};
  if (motion.status ==
      MotionStatus::outside_limits) {  // this is overshoot, because the limits are convex
    motion.reason.set(ReasonField::overshoots, true);
  }
  if (motion.status == MotionStatus::cancelled) return motion;
  motion.overshoot = joint_overshoot(motion.trajectory.positions, goal);
  if (reached) set_limit_usage(arm, budget, motion);
  return motion;
}

std::ostream& operator<<(std::ostream& out, const ControlledMotion& motion) {
  internal::print_motion(out, motion);
  return motion ? out << ", error " << number(motion.error) : out;
}

}  // namespace beeline
