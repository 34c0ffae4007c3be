#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/motion/path/through.h>

namespace beeline {

/// The place on the path, from `from` on and up to `to`, at which the tool at `pose` is: on a
/// single line the nearest (nearest_on_line.h); else the first at which the path comes nearest, as
/// far as the task asks, turns counted by `metres_of_a_radian`. It is found in steps of a 32nd of a
/// piece, within which a path should not turn back.
double nearest_place(const ToolPath& path, const Task& task, const Pose& pose, double from,
                     double to);

/// The same, or next to it a place at which the deviation is within the tolerance, if there is one
/// and the nearest place is none: position and orientation may be nearest at different places.
double fitting_place(const ToolPath& path, const Task& task, const Pose& pose, double from,
                     double to, const Deviation& tolerance);

}  // namespace beeline
