#pragma once

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Returns a local minimum, from q, of half the squared error of the task, limits ignored: Newton's
/// method with Levenberg's damping. Metres and radians weigh alike.
Configuration nearest_for_task(const Arm& arm, const Pose& world_T_tool, const Task& task,
                               const Configuration& q);

/// Returns the task's rows for the position.
Task position_part(const Task& task);

/// Returns a local minimum, from q, of the orientation error subject to the position:
/// Gauss-Newton steps in the null space of the position's Jacobian. q satisfies the position part
/// of the task, which has rows of both. Good to about 1e-3 rad where the minimum is at a stretched
/// arm.
Configuration nearest_orientation(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                  const Configuration& q);

}  // namespace beeline::internal
