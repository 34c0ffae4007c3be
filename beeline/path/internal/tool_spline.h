#pragma once

#include <beeline/path/tool_path.h>

namespace beeline {

/// path_through()'s spline, of poses that are checked.
ToolPath spline_through(std::span<const Pose> poses, const SplineEnds& ends);

}  // namespace beeline
