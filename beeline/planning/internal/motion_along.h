#pragma once

#include <beeline/planning/move_along.h>

namespace beeline::internal {

/// Plans as move_along(). A refused motion also has its trajectory, path parameters and deviation,
/// as far as there are any: they say where it is refused.
PathMotion motion_along(const Arm& arm, const std::optional<Configuration>& start,
                        const Route& route, const PathMotionOptions& options);

}  // namespace beeline::internal
