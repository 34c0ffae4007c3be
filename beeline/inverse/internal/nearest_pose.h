#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Returns the local minimum of |e|^2 / 2 that Newton's method with Levenberg's damping finds from
/// q. e is the task's error in metres and radians. Limits are ignored.
Configuration nearest_for_task(const Arm& arm, const Pose& world_T_tool, const Task& task,
                               const Configuration& q);

/// Returns the task's rows for the position.
Task position_part(const Task& task);

/// Minimises the orientation error from q subject to the position, to a local minimum, by
/// Gauss-Newton steps in the null space of the position's Jacobian. Requires that q satisfies the
/// position part of the task and that the task has rows of both. Accurate to about 1e-3 rad if the
/// arm is stretched at the minimum, unless the budget ends it.
Configuration nearest_orientation(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                  const Configuration& q, BudgetMeter& budget);

}  // namespace beeline::internal
