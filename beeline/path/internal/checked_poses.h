#pragma once

#include <span>
#include <string>
#include <vector>

#include <beeline/pose/se3.h>

namespace beeline::internal {

/// Returns the poses with orthogonal rotations; the given ones must be orthogonal to 1e-6, as after
/// rounding in text. Throws Error for a pose that is not a rigid motion, not finite or farther away
/// than 1e100 m, naming it by `noun` and number, and for more than max_poses poses.
std::vector<Pose> checked_poses(std::span<const Pose> poses, const std::string& noun = "pose");

/// The same for waypoints of lines. Throws Error if there are none.
std::vector<Pose> checked_waypoints(std::span<const Pose> waypoints);

}  // namespace beeline::internal
