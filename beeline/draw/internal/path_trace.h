#pragma once

#include <optional>
#include <vector>

#include <beeline/draw/timing_figure.h>

namespace beeline::internal {

/// The tool's deviation along its path, measured at the samples and at equal parts of the time
/// between them.
struct PathTrace {
  /// One measurement of the deviation.
  struct Point {
    std::size_t step = 0;            ///< index of the later sample; 0: the beginning of a segment
    double arc_length = 0;           ///< arc length along the path, metres
    Deviation deviation;             ///< deviation from the segment, see deviation_from()
    Vector3 tool = Vector3::Zero();  ///< tool position in the world, metres
    Vector3 deviation_vector =
        Vector3::Zero();  ///< vector of the tool position from the path, metres
  };
  /// The motion from one sample to the next, or the part of it on one segment.
  struct Step {
    double from = 0, to = 0;  ///< range of arc length, metres
    Deviation bound;          ///< interval_deviation()
  };
  std::vector<Point> points;
  std::vector<Step> steps;
  std::vector<double> segment_ends;  ///< arc length at the end of each segment that is reached
  std::vector<double> waypoints;     ///< arc length at each waypoint that is reached
  std::vector<Vector3> polyline;     ///< points of the path, metres
  /// Whether the length of some segment is the length of its rotation (`min_metres_per_radian` for
  /// each radian).
  bool has_pure_rotation = false;
};

/// The waypoints of a path with their path parameters, in order. A waypoint of `followed` is placed
/// at the nearest of the ends and middles of the next segments, because a blend passes its waypoint
/// in the middle. Without such waypoints, they are the ends of the segments.
struct PlacedWaypoints {
  std::vector<Pose> poses;
  std::vector<double> path_parameters;
};
PlacedWaypoints placed_waypoints(const FollowedPath& followed);

/// Returns the time at which the motion reaches the path parameter s, seconds; none if it ends
/// before.
std::optional<double> time_at(const Trajectory& trajectory, const FollowedPath& followed, double s);

/// Measures the deviation of a trajectory, whose columns are in the arm's order, from its path.
/// Throws Error when sizes do not fit.
PathTrace trace_path(const Arm& arm, const Trajectory& trajectory, const FollowedPath& followed);

}  // namespace beeline::internal
