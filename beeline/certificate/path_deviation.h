#pragma once

#include <span>
#include <vector>

#include <beeline/certificate/internal/segment_step.h>
#include <beeline/path/tool_path.h>

namespace beeline {

/// Throws Error unless step_bound() holds for the task: any along a line, for others see
/// check_matched().
void check_task(const Arm& arm, const Segment& segment, const Task& task);

/// Throws Error for a path without segments, and unless step_bound() holds for each.
void check_task(const Arm& arm, const ToolPath& path, const Task& task);

/// Throws Error unless the route has segments, for each its span and whether the arm stops behind
/// it, and what check_task() refuses.
void check_route(const Arm& arm, const Route& route, const Task& task);

bool all_lines(const ToolPath& path);

/// What matters of the segment does not move, but for 1e-9 m and rad.
bool stands_still(const Segment& segment, const Task& task);

/// How far `pose` is from the segment, as far as the task asks: from the nearest point of a line
/// (nearest_on_line.h), of other segments from the pose at s.
Deviation deviation_from(const Segment& segment, double s, const Pose& pose, const Task& task);

/// The same for a place on the path.
Deviation deviation_from(const ToolPath& path, double place, const Pose& pose, const Task& task);

/// A bound on deviation_from() while every joint moves in proportion from one end of the step to
/// the other, and s does too: line_step_bound(), matched_step_bound(). Throws Error when a
/// configuration does not fit the arm.
Deviation step_bound(const Arm& arm, const Segment& segment, const Task& task, const StepEnd& a,
                     const StepEnd& b);

/// What a motion does between two samples on one segment of its path.
struct SegmentStep {
  std::size_t segment = 0;
  Configuration q_a, q_b;
  double s_a = 0, s_b = 0;
};

/// The step from one place on the path to another that is not before it: where it goes over the end
/// of a segment, joints in proportion to ToolPath::spans, it is cut there.
std::vector<SegmentStep> cut_at_segments(const ToolPath& path, const Task& task,
                                         const ConfigurationRef& q_a, double place_a,
                                         const ConfigurationRef& q_b, double place_b);

/// A step's deviations at both ends and half-way, and its bound with these known: the lesser of
/// step_bound() and the larger of both halves' own, where what it cannot tell of a step is an
/// eighth.
struct MeasuredStep {
  Deviation begin, middle, end;
  Deviation bound;
};
MeasuredStep measured(const Arm& arm, const ToolPath& path, const Task& task,
                      const SegmentStep& step);

/// Throws Error unless the path parameters are on the path, in order.
void check_path_parameters(const ToolPath& path, std::span<const double> path_parameters);

/// How near a joint motion stays to its path, measured and proved.
struct PathDeviation {
  Deviation sampled;   ///< the largest deviation at the samples
  Deviation measured;  ///< at the samples and at places between them
  Deviation bound;     ///< proved: at no moment between samples, joints moving in proportion, more
};

/// `path_parameters[k]` is where on the path sample k is: segments done, with a share of the next.
/// On lines the nearest point counts whatever the share; that they are gone to their ends verify()
/// tells. Throws Error when sizes do not fit, for path parameters that are not on the path in
/// order, and what check_task() refuses.
PathDeviation path_deviation(const Arm& arm, std::span<const Configuration> samples,
                             std::span<const double> path_parameters, const ToolPath& path,
                             const Task& task);

/// The path parameters of samples of which `arrivals[i]` is the one that reaches the end of segment
/// i: between these the nearest ones (nearest_parameter()); behind the last all are at its end.
/// Throws Error when arrivals are not among the samples, in order, or more than segments.
std::vector<double> path_parameters_along(const Arm& arm, std::span<const Configuration> samples,
                                          const ToolPath& path,
                                          std::span<const std::size_t> arrivals, const Task& task);

/// The first sample at or behind the end of each segment, as far as the path parameters go.
std::vector<std::size_t> arrivals(std::span<const double> path_parameters);

}  // namespace beeline
