#pragma once

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// All rows of a twist, a position or a Jacobian, with those that the task does not have set to
/// zero. The rows are in the task's axes.
Twist masked(const Task& task, Twist twist);
Vector3 masked_position(const Task& task, Vector3 position);
void mask_rows(const Task& task, Eigen::Ref<Jacobian> columns);

}  // namespace beeline::internal
