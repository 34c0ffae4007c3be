#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/bounds.h>

namespace beeline::internal {

/// Max joints of an arm for which searches locate a minimum so. The Hessian of a longer chain takes
/// too long.
inline constexpr int max_refined = 12;

/// Moves q to a local minimum of |e|^2 / 2 within the bounds, by Newton's method with Levenberg's
/// damping. e is the task's error in metres and radians. Joints that are at a bound stay there if
/// the error would decrease beyond it. Returns whether it converges with an error above `least`,
/// units of length and radians: it ends when the error is below, or another joint reaches a bound.
/// It does not converge so from next to a solution, singular or not, nor if the budget ends it.
bool minimise_error(const Arm& arm, const Pose& world_T_tool, const Task& task,
                    const Bounds& bounds, double least, BudgetMeter& budget, Configuration& q);

}  // namespace beeline::internal
