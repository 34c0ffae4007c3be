#include <beeline/certificate/internal/line_step.h>
#include <beeline/certificate/internal/path_step.h>

namespace beeline::internal {

Deviation deviation_from(const Segment& segment, double s, const Pose& pose, const Task& task) {
  if (const auto* line = std::get_if<Line>(&segment)) return deviation_from(*line, pose, task);
  return task_deviation(task, pose_at(segment, s), pose);
}

Deviation deviation_from(const ToolPath& path, double s, const Pose& pose, const Task& task) {
  const std::size_t i = segment_at(path, s);
  return deviation_from(path.segments[i], s - static_cast<double>(i), pose, task);
}

Deviation step_bound(const Arm& arm, const Segment& segment, const Task& task, const StepEnd& a,
                     const StepEnd& b) {
  const auto* line = std::get_if<Line>(&segment);
  if (line == nullptr) return matched_step_bound(arm, segment, task, a, b);
  return line_step_bound(arm, *line, task, a.q, b.q, a.deviation, b.deviation);
}

}  // namespace beeline::internal
