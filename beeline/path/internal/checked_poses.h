#pragma once

#include <span>
#include <string>
#include <vector>

#include <beeline/pose/se3.h>

namespace beeline::internal {

/// Returns the poses with their rotations made orthogonal where they are so to 1e-6, as after
/// rounding in text. Throws Error, naming the pose by `noun` and number, where one is not a rigid
/// motion, not finite or farther away than 1e100 m, and where there are more than max_poses.
std::vector<Pose> checked_poses(std::span<const Pose> poses, const std::string& noun = "pose");

/// The same for waypoints of lines: throws Error where there are none.
std::vector<Pose> checked_waypoints(std::span<const Pose> waypoints);

/// The same for a path: throws Error for fewer than two poses and where one repeats the one before
/// it.
std::vector<Pose> checked_path(std::span<const Pose> poses);

}  // namespace beeline::internal
