#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/control/simulate.h>
#include <beeline/error.h>

namespace beeline {
namespace {

constexpr double diverged = 100;  // times the first error: no detour grows that far
constexpr int recent = 100;       // steps after a turn back in which the motion counts as swinging

/// Tells when an error no longer falls. While it creeps it has new least values, while it swings
/// out it has lower peaks: without either for `patience` steps the arm is stuck.
class Progress {
 public:
  static constexpr int patience = 1000;
  explicit Progress(double error) : least_(error), peak_before_(error) {}

  /// After each step; false when it is stuck.
  bool goes_on(double error) {
    constexpr double creep = 1e-12, decay = 1e-2;  // shares of the error that count as less
    ++since_least_;
    if (error < least_ * (1 - creep)) {
      least_ = error;
      since_least_ = 0;
    }
    peak_ = std::max(peak_, error);
    if (++steps_ % patience != 0) return true;
    const bool stuck = since_least_ >= patience && peak_ > peak_before_ * (1 - decay);
    peak_before_ = std::exchange(peak_, 0);
    return !stuck;
  }
  double least() const { return least_; }

 private:
  double least_, peak_before_, peak_ = 0;
  int since_least_ = 0, steps_ = 0;
};

/// The share of the step that the velocity limits allow, at most 1.
double allowed_share(const Arm& arm, const Configuration& step, double time_step) {
  double share = 1;
  for (int k = 0; k < arm.dof(); ++k) {
    const double most = arm.limits(k).velocity * time_step;
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
  if (options.max_steps < 1) throw Error("a motion needs at least one step");
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
  Progress progress(first_error);
  bool stuck = false;
  int since_turn = recent;
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
    if (motion.steps >= options.max_steps) {
      return stop(motion, MotionStatus::not_converged,
                  "after " + std::to_string(motion.steps) + " steps an error of " +
                      number(motion.error) + " is left: " +
                      (swings ? "it swings, the gain is too large"
                              : "the gain is too small, or allow more steps"));
    }
    if (stuck) {
      return stop(motion, MotionStatus::not_converged,
                  "the error has stayed at " + number(progress.least()) + " or above for " +
                      std::to_string(Progress::patience) + " steps: " +
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
    stuck = !progress.goes_on(motion.error);
  }
}

}  // namespace beeline
