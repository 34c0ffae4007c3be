#include <algorithm>
#include <cmath>

#include <beeline/control/simulate.h>
#include <beeline/error.h>

namespace beeline {
namespace {

constexpr double diverged = 100;          // times the first error: no detour grows that far
constexpr int patience = 1000;            // steps without a new smallest error: the arm is stuck
constexpr double least_progress = 1e-12;  // share of the error that counts as lessening it
constexpr int recent = 100;  // steps after a turn back in which the motion counts as swinging

/// The share of the step that the velocity limits allow, at most 1.
double allowed_share(const Arm& arm, const Configuration& step, double time_step) {
  double share = 1;
  for (int k = 0; k < arm.dof(); ++k) {
    const double most = arm.limits()[static_cast<std::size_t>(k)].velocity * time_step;
    if (std::abs(step[k]) > most) share = std::min(share, most / std::abs(step[k]));
  }
  return share;
}

bool stop(ControlledMotion& motion, MotionStatus status, const std::string& reason) {
  motion.status = status;
  motion.reason = reason;
  return false;
}

void append(ControlledMotion& motion, const Configuration& q, double time_step) {
  motion.trajectory.times.push_back(++motion.steps * time_step);
  motion.trajectory.positions.push_back(q);
}

}  // namespace

void check_options(const SimulationOptions& options) {
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance)) {
    throw Error("the tolerance must be above zero, not " + number(options.tolerance));
  }
  if (!(options.time_step > 0) || !std::isfinite(options.time_step)) {
    throw Error("the time step must be above zero, not " + number(options.time_step) + " s");
  }
  if (options.most_steps < 1) throw Error("a motion needs at least one step");
}

ControlledMotion begin_motion(const Arm& arm, const Configuration& start) {
  check_configuration(arm, start);
  const auto outside = limit_violations(arm, start);
  if (!outside.empty()) throw Error("the motion cannot start: " + outside.front());
  ControlledMotion motion;
  motion.trajectory = at_rest(arm, start);
  motion.trajectory.velocities.clear();
  motion.trajectory.accelerations.clear();
  return motion;
}

bool simulate(const Arm& arm, const ControlLaw& law, const SimulationOptions& options,
              ControlledMotion& motion) {
  Configuration q = motion.trajectory.positions.back();
  Configuration before = Configuration::Zero(arm.dof());  // the step asked for last
  motion.error = law.error(q);
  const double first_error = motion.error;
  double smallest = first_error;
  int since_smallest = 0, since_turn = recent;
  while (true) {
    const Configuration step = law.step(q);
    if (!step.allFinite()) {
      return stop(motion, MotionStatus::not_converged,
                  "the controller asks for a step without end");
    }
    const bool still = step.lpNorm<Eigen::Infinity>() <= options.tolerance;
    if (motion.error <= options.tolerance && still) return true;
    since_turn = step.dot(before) < 0 ? 0 : since_turn + 1;
    const bool swings = since_turn < recent;
    if (motion.steps >= options.most_steps) {
      return stop(motion, MotionStatus::not_converged,
                  "after " + std::to_string(motion.steps) + " steps an error of " +
                      number(motion.error) + " is left: " +
                      (swings ? "it swings, the gain is too large"
                              : "the gain is too small, or allow more steps"));
    }
    if (since_smallest >= patience) {
      return stop(motion, MotionStatus::not_converged,
                  "the error has stayed at " + number(smallest) + " or above for " +
                      std::to_string(patience) + " steps: " +
                      (swings ? "it swings, the gain is too large" : "the arm is stuck"));
    }
    const double share = allowed_share(arm, step, options.time_step);
    const Configuration next = q + share * step;
    const auto outside = limit_violations(arm, next);
    if (!outside.empty()) {
      return stop(motion, MotionStatus::outside_limits,
                  "step " + std::to_string(motion.steps + 1) +
                      " would leave the limits: " + outside.front());
    }
    if (share < 1) ++motion.slowed;
    q = next;
    before = step;
    append(motion, q, options.time_step);
    motion.error = law.error(q);
    if (!(motion.error <= diverged * std::max(first_error, options.tolerance))) {
      return stop(motion, MotionStatus::not_converged,
                  "the error grows without end, to " + number(motion.error) + " after " +
                      std::to_string(motion.steps) + " steps: the gain is too large");
    }
    ++since_smallest;
    if (motion.error < smallest * (1 - least_progress)) {
      smallest = motion.error;
      since_smallest = 0;
    }
  }
}

}  // namespace beeline
