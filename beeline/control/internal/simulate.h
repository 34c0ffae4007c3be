#pragma once

#include <functional>

#include <beeline/control/joint.h>
#include <beeline/internal/budget_meter.h>

namespace beeline::internal {

/// A controller in joint space.
struct ControlLaw {
  std::function<double(const Configuration& q)> error;        ///< remaining error at q
  std::function<Configuration(const Configuration& q)> step;  ///< change of q in one time step
};

/// Throws Error unless the tolerance and the time step are above zero and there is a step.
void check_options(const SimulationOptions& options);

/// Returns a motion that consists of its start. Throws Error when `start` does not fit the arm or
/// is outside its limits.
ControlledMotion begin_motion(const Arm& arm, const Configuration& start);

/// Simulates q ← q + step(q) from the motion's last sample until the error and the step are within
/// the tolerance, and appends each step to the motion. A step that exceeds velocity limits is
/// scaled down as a whole, which keeps its direction. Returns whether the goal was reached; stops
/// with a status and a reason when a step would leave the joint limits, the error diverges, the
/// error stagnates, `max_steps` are done, or the budget ends.
bool simulate(const Arm& arm, const ControlLaw& law, const SimulationOptions& options,
              ControlledMotion& motion);

/// Sets the limits that a motion uses and the jump of velocity at its start; the status if the
/// budget ends that.
void set_limit_usage(const Arm& arm, BudgetMeter& budget, ControlledMotion& motion);

}  // namespace beeline::internal
