#pragma once

#include <optional>
#include <string>

#include <beeline/planning/plan.h>

namespace beeline {

/// A path near another, which the arm can follow where it cannot follow that one.
struct NearbyPath {
  Vector3 moved = Vector3::Zero();   ///< all of it by this, metres, in the world's axes ...
  Vector3 turned = Vector3::Zero();  ///< ... or the tool by this rotation vector, in its own axes
  ToolPath path;
  std::string description;  ///< "moved by 0.012 m along -z", "with the tool turned by ..."
};

/// The least shift along one of the world's axes, or, if `turns`, the least turn of the tool about
/// one of its own, with which plan_path() goes through: of steps that double, up to 0.26 m and 0.64
/// rad, and then made smaller by halving. Nothing where none of them works. With a start the arm's
/// own first pose stays, and the first line leads on from there; nothing then for a path of other
/// segments. Planar arms move in their plane.
std::optional<NearbyPath> nearby_path(const Arm& arm, const std::optional<Configuration>& start,
                                      const ToolPath& path, const BranchOptions& options,
                                      bool turns);

}  // namespace beeline
