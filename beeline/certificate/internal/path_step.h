#pragma once

#include <vector>

#include <beeline/certificate/internal/matched_step.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/tool_path.h>

namespace beeline::internal {

/// Returns the deviation of `pose` from the segment, in the rows of the task: from the nearest
/// point of a line (nearest_on_line.h), or from the pose at s of another segment.
Deviation deviation_from(const Segment& segment, double s, const Pose& pose, const Task& task);

/// The same at the path parameter s: whole segments, with a fraction of the next.
Deviation deviation_from(const ToolPath& path, double s, const Pose& pose, const Task& task);

/// Bounds deviation_from() while the configuration and s move linearly from `a` to `b`:
/// line_step_bound() or matched_step_bound(). Throws Error when a configuration does not fit the
/// arm.
Deviation step_bound(const Arm& arm, const Segment& segment, const Task& task, const StepEnd& a,
                     const StepEnd& b);

/// A step from one sample to the next, or the part of it that is on one segment.
struct SegmentStep {
  std::size_t segment = 0;
  Configuration q_a, q_b;
  double s_a = 0, s_b = 0;  ///< of the segment, in [0, 1]
};

/// Splits the step from path parameter s_a to s_b >= s_a at the ends of segments, the joints moving
/// linearly in ToolPath::spans.
std::vector<SegmentStep> split_at_segments(const ToolPath& path, const Task& task,
                                           const ConfigurationRef& q_a, double s_a,
                                           const ConfigurationRef& q_b, double s_b);

/// The deviations of a step at its ends and at its midpoint, and a bound between them: the smaller
/// of the step's step_bound() and the larger one of its halves. The bounds of the halves are
/// smaller because they are proportional to the square of the step.
struct MeasuredStep {
  Deviation begin, middle, end;
  Deviation bound;
};
MeasuredStep measure_step(const Arm& arm, const ToolPath& path, const Task& task,
                          const SegmentStep& step);

}  // namespace beeline::internal
