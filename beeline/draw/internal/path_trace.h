#pragma once

#include <span>
#include <vector>

#include <beeline/draw/timing_figure.h>

namespace beeline::internal {

/// The tool's deviation along its path, measured at the samples and at equal parts of the time
/// between them.
struct PathTrace {
  /// One measurement.
  struct Point {
    std::size_t step = 0;   ///< the number of the later sample; 0: the beginning of a segment
    double arc_length = 0;  ///< along the path, metres
    Deviation deviation;    ///< from the segment, see deviation_from()
    Vector3 tool = Vector3::Zero();              ///< in the world, metres
    Vector3 deviation_vector = Vector3::Zero();  ///< of the tool position from the path, metres
  };
  /// The motion from one sample to the next, or the part of it on one segment.
  struct Step {
    double from = 0, to = 0;  ///< arc length, metres
    Deviation bound;          ///< interval_deviation()
  };
  std::vector<Point> points;
  std::vector<Step> steps;
  std::vector<double> segment_ends;  ///< arc length at the end of each segment
  std::vector<Vector3> polyline;     ///< the path, metres
  /// Some segment's length is that of its rotation (`min_metres_per_radian` for each radian).
  bool has_pure_rotation = false;
};

/// Measures the deviation of a trajectory, whose columns are in the arm's order, from its path.
/// Throws Error when sizes do not fit.
PathTrace trace_path(const Arm& arm, const Trajectory& trajectory, const FollowedPath& followed);

}  // namespace beeline::internal
