#pragma once

#include <optional>
#include <string>

#include <beeline/error.h>
#include <beeline/planning/branch.h>

namespace beeline {

/// A rigidly moved path that the arm can follow where it cannot follow the original one, or the
/// original path from another start.
struct NearbyPath {
  Vector3 moved = Vector3::Zero();   ///< translation of the path, metres, in world axes; or
  Vector3 turned = Vector3::Zero();  ///< rotation vector of all its poses, radians, in tool axes
  ToolPath path;
  std::optional<Configuration> start = std::nullopt;  ///< in place of the one that was given
  std::string description;  ///< "with every waypoint moved by 0.012 m along -z; ..."
};

/// Searches for the shortest translation along one of the world's axes or half-way between some of
/// them, or, if `rotate`, the smallest such rotation of the tool about its own axes, with which
/// plan_path() succeeds. Sizes quadruple from 4 mm to 0.256 m, or from 0.01 to 0.64 rad; those
/// of the directions that succeed first are refined by bisection. Each is first searched coarsely,
/// within a limit of work. Paths of planar arms move in the plane. With a start, the path's first
/// pose is kept and its first line leads to the moved path; a path whose first segment is no line,
/// or continues smoothly, then has no result. Where the budget ends the search, the result is empty
/// or not refined. Throws Error as plan_path() does.
std::optional<NearbyPath> nearby_path(const Arm& arm, const std::optional<Configuration>& start,
                                      const ToolPath& path, const BranchOptions& options,
                                      bool rotate);

}  // namespace beeline
