#pragma once

#include <string>

#include <beeline/io/text/internal/yaml.h>
#include <beeline/io/text/scene.h>

namespace beeline::internal {

/// Returns the scene of a message moveit_msgs/PlanningScene, see read_scene(). `options.frames` has
/// all frames that it may name. Throws FileError.
Scene planning_scene(const Yaml& yaml, const std::string& path, const ShapeOptions& options);

}  // namespace beeline::internal
