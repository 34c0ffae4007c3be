#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/control/internal/simulate.h>
#include <beeline/control/internal/time_step.h>
#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/model/internal/joint_reason.h>
#include <beeline/trajectory/internal/end_velocity.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/motion_start.h>

namespace beeline::internal {
namespace {

// The motion diverges when the error exceeds this multiple of the first error. The errors of
// converging motions grow by less, even if a tool first moves away from its goal.
constexpr double diverged = 100;
constexpr int recent = 100;  // steps after a reversal during which the motion counts as oscillating

/// Detects an error that no longer decreases. A slow approach has new minima, and a decaying
/// oscillation has lower peaks. The motion stagnates if neither occurs within `patience` steps.
class Convergence {
 public:
  static constexpr int patience = 1000;
  explicit Convergence(double error) : minimum_(error), last_peak_(error) {}

  /// Takes the error after each step; returns false when the motion stagnates.
  bool decreases(double error) {
    constexpr double min_decrease = 1e-12, min_decay = 1e-2;  // relative
    ++since_minimum_;
    if (error < minimum_ * (1 - min_decrease)) {
      minimum_ = error;
      since_minimum_ = 0;
    }
    peak_ = std::max(peak_, error);
    if (++steps_ % patience != 0) return true;
    const bool stuck = since_minimum_ >= patience && peak_ > last_peak_ * (1 - min_decay);
    last_peak_ = std::exchange(peak_, 0);
    return !stuck;
  }
  double minimum() const { return minimum_; }

 private:
  double minimum_, last_peak_, peak_ = 0;
  int since_minimum_ = 0, steps_ = 0;
};

/// Returns the largest scale in [0, 1] of the step within the velocity limits.
double allowed_scale(const Arm& arm, const Configuration& step, double time_step) {
  double scale = 1;
  for (int k = 0; k < arm.dof(); ++k) {
    const double allowed = arm.limits(k).velocity * time_step;
    if (std::abs(step[k]) > allowed) scale = std::min(scale, allowed / std::abs(step[k]));
  }
  return scale;
}

bool stop(ControlledMotion& motion, MotionStatus status, Reason reason) {
  motion.status = status;
  motion.reason = std::move(reason);
  return false;
}

/// Returns a reason with the number of steps so far and an error.
Reason after_steps(Reason reason, const ControlledMotion& motion, double error) {
  reason.set(ReasonField::step, static_cast<std::size_t>(motion.steps));
  return reason.set(ReasonField::error, error);
}

bool stop_by_budget(ControlledMotion& motion, Ending ending) {
  return stop(
      motion, status_of<MotionStatus>(ending),
      after_steps(ended_reason(ReasonCode::ended_in_simulation, ending), motion, motion.error));
}

void append(ControlledMotion& motion, const Configuration& q, double time_step) {
  motion.trajectory.times.push_back(++motion.steps * time_step);
  motion.trajectory.positions.push_back(q);
}

StartJump start_jump(const Arm& arm, const Trajectory& trajectory) {
  StartJump largest;
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits &known = arm.limits(k), limits = motion_limits(known);
    const EndVelocity start = end_velocity(trajectory, k, limits, TrajectoryEnd::first);
    const double fraction = std::abs(start.velocity) / limits.velocity;
    if (start.at_rest() || fraction <= largest.fraction) continue;
    largest = {start.velocity, fraction, arm.joint_of(k).name, !(known.velocity < Limits::none)};
  }
  return largest;
}

}  // namespace

void check_options(const SimulationOptions& options) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance)) {
    throw Error("the tolerance must be above zero, not " + number(options.tolerance));
  }
  check_time_step(options.time_step);
  constexpr int most = 10'000'000;  // for an arm of seven joints about 1 GB of samples
  if (options.max_steps < 1 || options.max_steps > most) {
    throw Error("", "max_steps",
                " must be from 1 to " + std::to_string(most) + ", not " +
                    std::to_string(options.max_steps));
  }
}

ControlledMotion begin_motion(const Arm& arm, const Configuration& start) {
  check_configuration(arm, start);
  check_start(arm, start);
  ControlledMotion motion;
  motion.trajectory = at_rest(arm, start);
  keep_columns(motion.trajectory, Interpolation::linear);
  return motion;
}

bool simulate(const Arm& arm, const ControlLaw& law, const SimulationOptions& options,
              ControlledMotion& motion) {
  Configuration q = motion.trajectory.positions.back();
  Configuration last = Configuration::Zero(arm.dof());  // the last step of the controller
  motion.error = law.error(q);
  const double first_error = motion.error;
  Convergence convergence(first_error);
  BudgetMeter budget(options.budget);
  bool stuck = false;
  int since_reversal = recent;
  while (true) {
    if (budget.ended()) return stop_by_budget(motion, budget.ending());
    const Configuration step = law.step(q);
    if (!step.allFinite()) {
      return stop(motion, MotionStatus::not_converged, {ReasonCode::step_not_finite});
    }
    const bool still = step.lpNorm<Eigen::Infinity>() <= options.tolerance;
    if (motion.error <= options.tolerance && still) return true;
    since_reversal = step.dot(last) < 0 ? 0 : since_reversal + 1;
    const bool oscillates = since_reversal < recent;
    if (motion.steps >= options.max_steps) {
      return stop(motion, MotionStatus::not_converged,
                  after_steps({ReasonCode::not_converged, {{ReasonField::oscillates, oscillates}}},
                              motion, motion.error));
    }
    if (stuck) {
      return stop(motion, MotionStatus::not_converged,
                  {ReasonCode::stagnates,
                   {{ReasonField::error, convergence.minimum()},
                    {ReasonField::count, static_cast<std::size_t>(Convergence::patience)},
                    {ReasonField::oscillates, oscillates}}});
    }
    const double scale = allowed_scale(arm, step, options.time_step);
    const Configuration next = q + scale * step;
    const auto outside = limit_violations(arm, next);
    if (!outside.empty()) {
      Reason reason = computed_violation(outside, ReasonCode::step_outside_limits);
      reason.set(ReasonField::step, static_cast<std::size_t>(motion.steps) + 1);
      return stop(motion, MotionStatus::outside_limits, std::move(reason));
    }
    if (scale < 1) ++motion.slowed;
    q = next;
    last = step;
    append(motion, q, options.time_step);
    motion.error = law.error(q);
    if (!(motion.error <= diverged * std::max(first_error, options.tolerance))) {
      return stop(motion, MotionStatus::not_converged,
                  after_steps({ReasonCode::diverges}, motion, motion.error));
    }
    stuck = !convergence.decreases(motion.error);
  }
}

void set_limit_usage(const Arm& arm, BudgetMeter& budget, ControlledMotion& motion) {
  motion.start_jump = start_jump(arm, motion.trajectory);
  motion.limits = limit_usage(arm, motion.trajectory, budget.part());
  if (motion.limits.ending == Ending::complete) return;
  set_ended(ReasonCode::ended_before_check, motion.limits.ending, motion);
}

}  // namespace beeline::internal
