#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/motion/path/piece.h>

namespace beeline {

/// A bound on deviation_from(line, ..., task) while every joint moves in proportion from q_a to
/// q_b, at whose ends it was measured to be `a` and `b`. From chord_bound(), so it falls with the
/// square of the step; but only with the step itself where the task leaves two of the orientation
/// rows free, or some position rows in the tool's axes, for there the rows that matter turn. Throws
/// Error when q_a or q_b does not fit the arm.
Deviation line_step_bound(const Arm& arm, const Line& line, const Task& task,
                          const ConfigurationRef& q_a, const ConfigurationRef& q_b,
                          const Deviation& a, const Deviation& b);

}  // namespace beeline
