#pragma once

#include <beeline/path/tool_path.h>

namespace beeline::internal {

/// The spline of path_through(), through poses that are checked.
ToolPath spline_through(std::span<const Pose> poses, const SplineEnds& ends);

}  // namespace beeline::internal
