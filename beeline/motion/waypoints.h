#pragma once

#include <span>
#include <vector>

#include <beeline/pose/se3.h>

namespace beeline {

/// The waypoints with their rotations freed of the rounding of text, up to 1e-6.
/// Throws Error when there are none, or one is no rigid motion or not finite, naming it.
std::vector<Pose> checked_waypoints(std::span<const Pose> waypoints);

}  // namespace beeline
