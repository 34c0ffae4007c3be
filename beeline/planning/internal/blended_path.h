#pragma once

#include <vector>

#include <beeline/path/joint_path.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// A waypoint that straight joint motions pass without a stop: its blend leaves the line before it
/// `radius` in front of it and meets the line after it as far behind.
struct JointBlend {
  Configuration before, at, after;  ///< the waypoint and its neighbours
  double radius = 0;                ///< norm of the difference, above 0

  Configuration begin() const { return at - radius * (at - before).normalized(); }
  Configuration end() const { return at + radius * (after - at).normalized(); }
  /// The blend as a motion with the path parameter, the arc length of the lines, as its time. It is
  /// the quintic polynomial with the directions of the lines and without curvature at its ends.
  Trajectory curve(const std::vector<std::string>& joint_names) const;
};

/// Returns whether the path turns by so much at the waypoint that it would nearly rest in a blend.
bool turns_back(const JointBlend& blend);

/// Returns the path of straight joint motions between waypoints, with a blend at each inner one.
/// `radii` has their radii, above 0; two of neighbours are together at most their distance.
JointPath blended_path(const std::vector<Configuration>& waypoints,
                       const std::vector<double>& radii);

}  // namespace beeline::internal
