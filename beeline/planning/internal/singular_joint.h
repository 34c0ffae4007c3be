#pragma once

#include <optional>

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Returns the coordinate by which a singular arm is singular, such as the middle joint of a wrist:
/// of all, the inverse condition number of the task's Jacobian rises most when it alone is changed
/// by 0.1 rad, or by a tenth of the arm's size. Nothing if no joint alone raises it tenfold, to
/// 0.001 at least.
std::optional<int> singular_joint(const Arm& arm, const Task& task, const Configuration& q);

}  // namespace beeline::internal
