#pragma once

#include <beeline/certificate/internal/matched_step.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/tool_path.h>

namespace beeline::internal {

/// Returns the deviation of `pose` from the segment, in the rows of the task: from the nearest
/// point of a line (nearest_on_line.h), or from the pose at s of another segment.
Deviation deviation_from(const Segment& segment, double s, const Pose& pose, const Task& task);

/// Returns the deviation at the path parameter s: whole segments, with a fraction of the next.
Deviation deviation_from(const ToolPath& path, double s, const Pose& pose, const Task& task);

/// Bounds deviation_from() while the configuration and s move linearly from `a` to `b`:
/// line_step_bound() or matched_step_bound(). Throws Error when a configuration does not fit the
/// arm.
Deviation step_bound(const Arm& arm, const Segment& segment, const Task& task, const StepEnd& a,
                     const StepEnd& b);

}  // namespace beeline::internal
