#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/path/segment.h>

namespace beeline {

enum class PathKind { line, screw, arc, spline };
std::string name(PathKind kind);
std::vector<std::string> path_kind_names();

/// Throws Error listing the kinds for another name.
PathKind path_kind_named(std::string_view name);

/// A sequence of segments; each begins at the end of the one before. All poses are world_T_tool.
/// The path parameter s of a pose is the number of segments before it plus its segment parameter:
/// 2.25 is a quarter of the third segment.
struct ToolPath {
  std::vector<Segment> segments;  ///< segments in order
  /// The length of each segment in the common parameter of the path, about metres: see span_of().
  /// On a smooth path the velocity with respect to it, motion_at() divided by the span, is
  /// continuous.
  std::vector<double> spans;
  /// Name of each segment in messages, such as `move 3 (line)`, `the blend at pose 3`; empty: `line
  /// 3`, `segment 3`.
  std::vector<std::string> names = {};
};

/// The name of segment i in messages.
std::string segment_name(const ToolPath& path, std::size_t i);

/// Max number of poses of a path. Planning takes about 2 ms for each.
constexpr std::size_t max_poses = 20'000;

/// The smallest limit of the tool's speed, metres per second.
constexpr double slowest_tool = 1e-8;

/// A path and the stops of the tool on it.
struct Route {
  ToolPath path;  ///< path of the tool
  /// Whether the tool stops after each segment; it always stops after the last.
  std::vector<bool> stops;
  /// Limit of the tool origin's speed on each segment, m/s; empty: the limit of the motion's
  /// options.
  std::vector<double> speeds = {};
};

/// Returns the route along a path. Lines, screws and arcs have a stop between two segments; a
/// spline has stops only where it turns back.
Route route_of(ToolPath path, PathKind kind);

/// The weight of a rotation in a sum of lengths and angles, metres per radian.
constexpr double metres_per_radian = 0.2;

/// A line that translates by less than this per radian of its rotation is parameterised by its
/// rotation: metres per radian.
constexpr double min_metres_per_radian = 0.01;

/// The span of a line, metres: the larger of its length and min_metres_per_radian times its
/// rotation angle.
double span_of(const Line& line);

/// End conditions of a spline: a given velocity (in world axes, with respect to the common
/// parameter: about metres and radians per metre; zero: at rest), or else zero acceleration.
struct SplineEnds {
  std::optional<Twist> first = std::nullopt;
  std::optional<Twist> last = std::nullopt;
};

/// Whether a pose of a path repeats the one before it: they are within 1e-12 m and rad.
bool repeats(const Pose& pose, const Pose& before);

/// The pose (world_T_tool) at path parameter s.
Pose pose_at(const ToolPath& path, double s);

/// The span from the path's beginning to path parameter s.
double span_to(const ToolPath& path, double s);

/// The path traversed from its end to its beginning.
ToolPath reversed(const ToolPath& path);

/// Whether the tool's velocity with respect to the common parameter is discontinuous at s, as
/// where lines meet.
bool corner_at(const ToolPath& path, double s);

/// The index of the segment at s; if two segments meet there, of the one that ends there.
std::size_t segment_at(const ToolPath& path, double s);

/// Returns the path through the poses (world_T_tool) in order. Lines and screws join neighbours.
/// Each arc takes two more poses; only the position of the first of them counts. A spline passes
/// through all poses, and its velocity and acceleration, linear and angular, are continuous. If it
/// would turn back at a pose, as at the second of A, B, A, it is divided into two splines there.
/// The condition is that its speed with respect to the chord length, 1.5 cos(a/2) between two equal
/// chords with an angle a between their directions, is below 0.03, so a is above 177.7 degrees.
///
/// The spline's positions are cubic in the chord length, the root of the sum of the squares of the
/// distance and of metres_per_radian times the rotation angle. The rotation vectors of the shortest
/// rotations from each pose to the next, summed, have such a spline too: its derivatives are taken
/// as angular velocities and accelerations at the poses. Between two poses the rotation vector
/// relative to the orientation half-way between them is the quintic Hermite polynomial with these
/// values at both ends. It is related to F. C. Park and B. Ravani, "Smooth invariant interpolation
/// of rotations", ACM Transactions on Graphics 16(3), 1997, whose cubics depend on the poses
/// before. The path is equivariant: a rigid motion of all poses moves the path with them, and poses
/// in reverse order give the reversed path.
///
/// A pose may repeat the one before it. The line or screw between them has no length: the tool
/// rests, and each pose after the first still ends a segment, as with lines_through(). So has an
/// arc whose three poses are equal. A spline passes a repeated pose once, and adds no segment for
/// it; a spline through equal poses is one line without length.
///
/// Throws Error for too few poses, an even number of poses for arcs, a pose that is not a rigid
/// motion, and what arc_through() refuses, such as two equal positions of an arc.
ToolPath path_through(std::span<const Pose> poses, PathKind kind, const SplineEnds& ends = {});

/// Returns straight lines through the poses (world_T_tool) in order, as path_through() does. A pose
/// may repeat the one before it: the line between them has no length. Throws Error for fewer than
/// two poses, and for a pose that is not a rigid motion.
ToolPath lines_through(std::span<const Pose> poses);

}  // namespace beeline
