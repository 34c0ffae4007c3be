#pragma once

#include <optional>

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Returns the coordinate that makes an arm singular, such as the middle joint of a wrist. A change
/// of this coordinate by 0.1 rad, or by a tenth of the arm's size, raises the inverse condition
/// number of the task's Jacobian most. Returns nothing if no change of one coordinate raises it
/// tenfold, to at least 0.001.
std::optional<int> singular_joint(const Arm& arm, const Task& task, const Configuration& q);

}  // namespace beeline::internal
