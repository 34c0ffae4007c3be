#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/tool_path.h>

namespace beeline::internal {

/// The path parameter in [from, to] that belongs to a tool at `pose`. On a single line it is the
/// nearest point (nearest_on_line.h). Else it is the first local minimum of the distance, in the
/// rows that the task constrains and with rotations weighted by metres_per_radian: a scan in steps
/// of 1/32 of a segment, within which the distance should have one minimum, then Gauss-Newton.
double nearest_parameter(const ToolPath& path, const Task& task, const Pose& pose, double from,
                         double to);

/// The same if the deviation there is within the tolerance; else the next path parameter, up to two
/// segments on, at which it is. Position and orientation may be nearest at different parameters,
/// and the path may lead away from the pose before it reaches it, as near a corner.
double fitting_parameter(const ToolPath& path, const Task& task, const Pose& pose, double from,
                         double to, const Deviation& tolerance);

}  // namespace beeline::internal
