#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/segment.h>

namespace beeline {

/// Whether line_step_bound() falls only with the step itself, not with its square: where the task
/// leaves two of the orientation rows free, or some position rows in the tool's axes.
bool bound_is_linear(const Arm& arm, const Task& task);

/// A bound on deviation_from(line, ..., task) while every joint moves in proportion from q_a to
/// q_b, at whose ends it was measured to be `a` and `b`. From chord_bound(), so it falls with the
/// square of the step; but see bound_is_linear(): there the rows that matter turn. Throws Error
/// when q_a or q_b does not fit the arm.
Deviation line_step_bound(const Arm& arm, const Line& line, const Task& task,
                          const ConfigurationRef& q_a, const ConfigurationRef& q_b,
                          const Deviation& a, const Deviation& b);

}  // namespace beeline
