#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/segment.h>

namespace beeline::internal {

/// Bounds deviation_from(line, ..., task), the deviation from the nearest point of the line, while
/// the configuration moves linearly from q_a to q_b; `a` and `b` are the deviations there.
///
/// Let s_a and s_b be the parameters of the nearest points at the ends, and s' linear between them.
/// The bound is a sum: the first term bounds the deviation from the line's pose at s', by
/// chord_bound(); the second bounds the change from s' to the nearest point's parameter. It is
/// proportional to the square of the step, except for a task that leaves two of the orientation
/// rows free, or some position rows in tool axes: then to the step. Throws Error when q_a or q_b
/// does not fit the arm.
Deviation line_step_bound(const Arm& arm, const Line& line, const Task& task,
                          const ConfigurationRef& q_a, const ConfigurationRef& q_b,
                          const Deviation& a, const Deviation& b);

}  // namespace beeline::internal
