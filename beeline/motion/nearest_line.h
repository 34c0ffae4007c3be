#pragma once

#include <optional>
#include <string>

#include <beeline/motion/plan.h>

namespace beeline {

/// Lines near others, which the arm can follow where it cannot follow these.
struct NearbyLines {
  Vector3 moved = Vector3::Zero();   ///< every pose by this, metres, in the world's axes ...
  Vector3 turned = Vector3::Zero();  ///< ... or the tool by this rotation vector, in its own axes
  std::vector<Pose> poses;
  std::string description;  ///< "moved by 0.012 m along -z", "with the tool turned by ..."
};

/// The least shift along one of the world's axes, or, if `turns`, the least turn of the tool about
/// one of its own, with which plan_lines() goes through with ten times the tolerance: of steps that
/// double, up to 0.26 m and 0.64 rad, and then made smaller by halving. Nothing where none of them
/// works. With a start the arm's own first pose stays, and the lines begin there. Planar arms move
/// in their plane.
std::optional<NearbyLines> nearest_lines(const Arm& arm, const std::optional<Configuration>& start,
                                         std::span<const Pose> poses, const BranchOptions& options,
                                         bool turns);

}  // namespace beeline
