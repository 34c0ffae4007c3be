#pragma once

#include <vector>

#include <beeline/collision/scene.h>
#include <beeline/io/text/internal/ros_message.h>

namespace beeline::internal {

/// Returns the pairs of names that a message moveit_msgs/AllowedCollisionMatrix allows to collide:
/// by its entry for the two, and by its default for one of them. Where it has both, or two of one
/// kind, all must allow it. A default holds for the names of the matrix and of the scene's
/// obstacles. Throws FileError.
std::vector<NamedPair> exempted_pairs(const RosMessage& matrix, const Scene& scene);

}  // namespace beeline::internal
