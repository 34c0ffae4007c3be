#pragma once

#include <string>
#include <string_view>

#include <beeline/collision/scene.h>

namespace beeline::internal {

/// Reads the text that MoveIt's PlanningScene writes of its objects, of both versions, see
/// read_scene(): in the second an object has a pose and subframes. `planning_frame` is the pose of
/// MoveIt's planning frame in the world. Throws FileError.
Scene moveit_scene(std::string_view bytes, const std::string& path, const Pose& planning_frame);

}  // namespace beeline::internal
