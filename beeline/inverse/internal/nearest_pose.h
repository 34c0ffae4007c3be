#pragma once

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// From q downhill to where the task's error is least, limits ignored: Newton's method on half its
/// square, with as much damping as it takes to descend. Lengths and angles weigh alike.
Configuration nearest_for_task(const Arm& arm, const Pose& world_T_tool, const Task& task,
                               const Configuration& q);

/// The rows of the task that are about the position.
Task position_part(const Task& task);

/// From q, which satisfies the task's position part, to where its orientation part is nearest while
/// the position stays: Gauss-Newton steps for the orientation within the position's null space.
/// Requires a task with rows of both. Good to about 1e-3 rad where that is at a stretched arm.
Configuration nearest_orientation(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                  const Configuration& q);

}  // namespace beeline::internal
