#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Returns the task with as many of its rows as the arm moves independently of each other at almost
/// all configurations. The remaining rows either are constant, such as the height of a planar arm's
/// tool, or follow from these. An arm with fewer joints than rows keeps all rows if its joints move
/// the tool independently of each other. The task has no rows if the arm moves none of them.
///
/// The rank of the task's Jacobian is computed at some configurations, so this may guide a search
/// and proves nothing.
Task independent_rows(const Arm& arm, const Task& task);

/// Whether the arm has more joints than the task has independent rows.
bool is_redundant(const Arm& arm, const Task& task);

}  // namespace beeline::internal
