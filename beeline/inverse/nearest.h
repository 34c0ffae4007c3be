#pragma once

#include <beeline/kinematics/task.h>

namespace beeline {

/// From q downhill to where the task's error is least, limits ignored: Newton's method on half its
/// square, with as much damping as it takes to descend. Lengths and angles weigh alike.
Configuration nearest_for_task(const Arm& arm, const Pose& world_T_tool, const Task& task,
                               const Configuration& q);

/// From q, which satisfies the position, to where the orientation is nearest to the pose's while
/// the position stays: Gauss-Newton steps for the orientation within the position's null space.
Configuration nearest_orientation(const Arm& arm, const Pose& world_T_tool, const Configuration& q);

}  // namespace beeline
