#pragma once

#include <vector>

#include <beeline/certificate/internal/interval_deviation.h>
#include <beeline/path/tool_path.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The motion between two samples, or the part of it along one segment.
struct PathInterval {
  std::size_t segment = 0;
  double from = 0, to = 1;  ///< fractions of the time between the two samples
  Interval interval;
};

/// Returns the motion of the trajectory, whose columns are in the arm's order, between sample k and
/// the next, divided at the ends of the path's segments. The path parameters of the two samples are
/// s_a and s_b >= s_a. Between them the path parameter, in ToolPath::spans, is a quintic. Its first
/// and second derivatives at both samples are those with which the path's pose follows the tool, so
/// for a tool on the path the error and its first two derivatives vanish there.
std::vector<PathInterval> path_intervals(const Arm& arm, const Trajectory& trajectory,
                                         std::size_t k, const ToolPath& path, const Task& task,
                                         double s_a, double s_b);

}  // namespace beeline::internal
