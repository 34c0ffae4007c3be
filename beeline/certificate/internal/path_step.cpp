#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/line_step.h>
#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/path_step.h>
#include <beeline/kinematics/forward.h>

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

std::vector<SegmentStep> split_at_segments(const ToolPath& path, const Task& task,
                                           const ConfigurationRef& q_a, double s_a,
                                           const ConfigurationRef& q_b, double s_b) {
  const auto last = static_cast<double>(path.segments.size() - 1);
  const auto first_segment = static_cast<std::size_t>(std::clamp(std::floor(s_a), 0.0, last));
  const std::size_t last_segment = std::max(first_segment, segment_at(path, s_b));
  if (first_segment == last_segment) {
    const auto begin = static_cast<double>(first_segment);
    return {{first_segment, q_a, q_b, s_a - begin, s_b - begin}};
  }
  std::vector<SegmentStep> steps;
  std::vector<double> spans;
  double total = 0;
  for (std::size_t i = first_segment; i <= last_segment; ++i) {
    const auto begin = static_cast<double>(i);
    const double from = std::max(s_a - begin, 0.0), to = std::min(s_b - begin, 1.0);
    steps.push_back({i, {}, {}, from, to});
    spans.push_back(stands_still(path.segments[i], task) ? 0 : (to - from) * path.spans[i]);
    total += spans.back();
  }
  double span = 0;
  Configuration q = q_a;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i].q_a = q;
    span += spans[i];
    if (i + 1 == steps.size()) {
      q = q_b;
    } else {
      q = q_a + (total > 0 ? span / total : 0) * (q_b - q_a);
    }
    steps[i].q_b = q;
  }
  return steps;
}

MeasuredStep measure_step(const Arm& arm, const ToolPath& path, const Task& task,
                          const SegmentStep& step) {
  const Segment& segment = path.segments[step.segment];
  const auto end = [&](const Configuration& q, double s) {
    return StepEnd{q, s, deviation_from(segment, s, forward_kinematics(arm, q), task)};
  };
  const Configuration half_way = (step.q_a + step.q_b) / 2;
  const StepEnd a = end(step.q_a, step.s_a), b = end(step.q_b, step.s_b);
  const StepEnd middle = end(half_way, (step.s_a + step.s_b) / 2);
  const Deviation whole = step_bound(arm, segment, task, a, b);
  Deviation halves = step_bound(arm, segment, task, a, middle);
  grow(halves, step_bound(arm, segment, task, middle, b));
  return {
      a.deviation,
      middle.deviation,
      b.deviation,
      {std::min(whole.position, halves.position), std::min(whole.orientation, halves.orientation)}};
}

}  // namespace beeline::internal
