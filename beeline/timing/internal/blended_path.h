#pragma once

#include <vector>

#include <beeline/path/joint_path.h>
#include <beeline/timing/internal/timed_section.h>
#include <beeline/trajectory/trajectory.h>

// Joint motions between waypoints that pass inner waypoints in blends. Distances are norms of
// differences of configurations, which add radians and metres.

namespace beeline::internal {

// A small blend curves so much that a stop may be quicker, as the jerk is limited.
constexpr double small_blend = 0.05;  ///< radius below which both are tried
constexpr double least_blend = 1e-3;  ///< radius below which the arm stops

/// A waypoint that straight joint motions pass without a stop: its blend leaves the line before it
/// `radius` in front of it and meets the line after it as far behind.
struct JointBlend {
  Configuration before, at, after;  ///< the waypoint and its neighbours
  double radius = 0;                ///< above 0

  Configuration begin() const { return at - radius * (at - before).normalized(); }
  Configuration end() const { return at + radius * (after - at).normalized(); }
  /// The blend as a motion with the path parameter, the arc length of the lines, as its time. It is
  /// the quintic polynomial with the directions of the lines and without curvature at its ends. It
  /// is in the triangle of the three configurations, and so within limits that these are within.
  Trajectory curve(const std::vector<std::string>& joint_names) const;
};

/// Returns whether the path turns by so much at the waypoint that it would nearly rest in a blend.
bool turns_back(const JointBlend& blend);

/// Returns the blend at inner waypoint k, as large as `most` and the neighbours allow.
JointBlend largest_blend(const std::vector<Configuration>& waypoints, std::size_t k, double most);

/// Returns the radii of the largest blends at inner waypoints; 0, a stop, where the path turns back
/// or the blend would be below `least_blend`.
std::vector<double> largest_blends(const std::vector<Configuration>& waypoints, double most);

/// Returns the radii with stops, 0, in place of those that are smaller than `radius`.
std::vector<double> with_stops_below(double radius, std::vector<double> radii);

/// A joint path with the limits of the tool's speed along it.
struct LimitedPath {
  JointPath path = {};
  ToolSpeeds tool_speeds = {};
};

/// Returns the straight joint path between two configurations, by its length.
JointPath straight_path(const Configuration& from, const Configuration& to);

/// Returns the point of a joint path at a parameter.
PathPoint point_at(const JointPath& path, double s);

/// Appends a point to a joint path, unless it touches the last one.
void add_point(JointPath& path, double s, const PathPoint& point);

/// Returns the blend from a joint path, whose last part of a length it replaces, to the next one,
/// whose first part of this length it replaces: the quintic polynomial with their derivatives at
/// its ends. Its parameter is 0 at its beginning.
JointPath blend_between(const JointPath& before, const JointPath& after, double radius);

/// Returns the paths from stop to stop along joint paths of which each begins where the one before
/// it ends, with a blend after paths[i] if radii[i] is not 0. In a blend the lower one of both
/// limits of the tool's speed holds. Parameters are lengths in joint space, about.
std::vector<LimitedPath> joined_paths(const std::vector<LimitedPath>& paths,
                                      const std::vector<double>& radii);

/// Returns the paths of straight joint motions between waypoints, from stop to stop, with a blend
/// at each inner waypoint whose radius is not 0. The radii of two neighbours are together at most
/// their distance.
std::vector<JointPath> blended_paths(const std::vector<Configuration>& waypoints,
                                     const std::vector<double>& radii);

}  // namespace beeline::internal
