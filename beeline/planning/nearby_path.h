#pragma once

#include <optional>
#include <string>

#include <beeline/error.h>
#include <beeline/planning/branch.h>

namespace beeline {

/// A rigidly moved path that the arm can follow where it cannot follow the original one.
struct NearbyPath {
  Vector3 moved = Vector3::Zero();   ///< translation of the path, metres, in world axes; or
  Vector3 turned = Vector3::Zero();  ///< rotation vector of all its poses, radians, in tool axes
  ToolPath path;
  std::string description;  ///< "moved by 0.012 m along -z", "with the tool turned by ..."
};

/// Searches for the shortest translation along one of the world's axes, or, if `rotate`, the
/// smallest rotation of the tool about one of its own axes, with which plan_path() succeeds. Sizes
/// double from 1 mm to 0.26 m, or from 0.01 to 0.64 rad; the first that succeeds is refined by
/// bisection. Paths of planar arms move in the plane. With a start, the path's first pose is kept
/// and its first line leads to the moved path; paths with other segments than lines then have no
/// result. Where the budget ends the search, the result is empty or not refined. Throws Error as
/// plan_path() does.
std::optional<NearbyPath> nearby_path(const Arm& arm, const std::optional<Configuration>& start,
                                      const ToolPath& path, const BranchOptions& options,
                                      bool rotate);

}  // namespace beeline
