#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/path/segment.h>

namespace beeline {

enum class PathKind { line, screw, arc, spline };
std::string name(PathKind kind);
PathKind path_kind_named(std::string_view name);  ///< throws Error for another name

/// Pieces, each of which begins where the one before it ends, and how much of one parameter each
/// takes. A smooth path's velocity is continuous by that parameter: motion_at() over the span.
struct ToolPath {
  std::vector<Segment> segments;
  std::vector<double> spans;  ///< about metres
};

/// Pieces, and where the tool comes to rest on them.
struct Route {
  ToolPath path;
  std::vector<bool> stops;  ///< after each segment; the last is one whatever it says
};

/// Lines, screws and arcs stop where two of them meet; a spline goes through.
Route route_of(ToolPath path, PathKind kind);

/// Where a distance is to count for turns too: metres a radian.
constexpr double metres_per_radian = 0.2;

/// How a spline begins and ends: with a velocity (world axes, by the parameter: about metres and
/// radians for each metre; zero: at rest), or else without acceleration.
struct SplineEnds {
  std::optional<Twist> first = std::nullopt;
  std::optional<Twist> last = std::nullopt;
};

/// A line's size, metres: its length, or `least_metres_per_radian` of its turn where that is more.
double span_of(const Line& line);

/// The pose at a place: whole segments, with a share of the next.
Pose pose_at(const ToolPath& path, double place);

/// The way to a place: spans of segments, with the share of the next.
double span_to(const ToolPath& path, double place);

/// The path gone from its end to its begin.
ToolPath reversed(const ToolPath& path);

/// Whether the tool's velocity, by the parameter, jumps at the place, as it does where lines meet.
bool corner_at(const ToolPath& path, double place);

/// The segment that a place is on, of two the one that ends there.
std::size_t segment_at(const ToolPath& path, double place);

/// A path through the poses in order. Lines and screws join neighbours; arcs each take two more
/// poses, of the first of which the position alone counts; a spline passes them all, its velocity
/// and acceleration, angular ones too, continuous by the parameter.
///
/// The spline's positions are cubic over the lengths of the chords, to which the turns are added by
/// `metres_per_radian` (the root of the squares' sum). The shortest turns from each pose to the
/// next, added up as vectors, have such a spline too: its velocities and accelerations are taken as
/// angular ones at the poses. Between two poses the rotation vector from the orientation half-way
/// between them is the polynomial of fifth degree that has them at both ends: like Park & Ravani,
/// "Smooth invariant interpolation of rotations" (1997), whose cubic ones need the poses before.
/// Rigid motions of all poses move the path with them; poses in reverse make the path in reverse.
///
/// Throws Error for too few poses, their number even for arcs, one that is not a rigid motion, or
/// that repeats the one before it; and what arc_through() refuses.
ToolPath path_through(std::span<const Pose> poses, PathKind kind, const SplineEnds& ends = {});

/// Straight lines through the poses in order; one may repeat the one before it. Throws Error for
/// fewer than two poses, and what checked_poses() refuses.
ToolPath lines_through(std::span<const Pose> poses);

/// checked_pose() of each; an error names the pose by `noun` and its number, from 1.
std::vector<Pose> checked_poses(std::span<const Pose> poses, const std::string& noun = "pose");

/// The same for what is to be reached in lines: throws Error where there are none.
std::vector<Pose> checked_waypoints(std::span<const Pose> waypoints);

/// The same, and throws Error for fewer than two poses and where one repeats the one before it.
std::vector<Pose> checked_path(std::span<const Pose> poses);

}  // namespace beeline
