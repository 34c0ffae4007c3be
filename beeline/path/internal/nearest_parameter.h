#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

namespace beeline {

/// The place on the path, from `from` on and up to `to`, at which the tool at `pose` is: on a
/// single line the nearest (nearest_on_line.h); else the first at which the path comes nearest, as
/// far as the task asks, turns counted by `metres_per_radian`. It is found in steps of a 32nd of a
/// segment, within which a path should not turn back.
double nearest_parameter(const ToolPath& path, const Task& task, const Pose& pose, double from,
                         double to);

/// The same, or, if that is none, the next place at which the deviation is within the tolerance, up
/// to two segments on: position and orientation may be nearest at different places, and the path
/// may lead away from the pose before it comes to it, as round a corner.
double fitting_parameter(const ToolPath& path, const Task& task, const Pose& pose, double from,
                         double to, const Deviation& tolerance);

}  // namespace beeline
