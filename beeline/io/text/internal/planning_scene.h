#pragma once

#include <string>
#include <string_view>

#include <beeline/io/text/scene.h>

namespace beeline::internal {

/// Reads a message moveit_msgs/PlanningScene, YAML or JSON, see read_scene(). Throws FileError.
Scene planning_scene(std::string_view text, const std::string& path, const ShapeOptions& options);

}  // namespace beeline::internal
