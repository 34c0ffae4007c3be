#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/path_step.h>
#include <beeline/draw/internal/path_trace.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>

namespace beeline::internal {
namespace {

/// Projects a vector on the position rows of the task, for a tool at `pose`; in the world's axes.
Vector3 in_rows(const Task& task, const Pose& pose, const Vector3& v) {
  const Vector3 kept = internal::in_position_rows(task, pose, v);
  const bool in_tool_axes = task.frame == Frame::tool && task.positions() < 3;
  return in_tool_axes ? Vector3(pose.linear() * kept) : kept;
}

/// A segment with its range of arc length.
struct Interval {
  const Segment& segment;
  double begin = 0, length = 0;
};

PathTrace::Point measure(const Arm& arm, const Configuration& q, double s, std::size_t step,
                         const Interval& interval, const Task& task) {
  const Pose pose = forward_kinematics(arm, q);
  if (const auto* line = std::get_if<Line>(&interval.segment))
    s = internal::nearest_fraction(*line, pose, task);
  const Pose wanted = pose_at(interval.segment, s);
  return {step, interval.begin + s * interval.length, task_deviation(task, wanted, pose),
          pose.translation(), in_rows(task, pose, pose.translation() - wanted.translation())};
}

/// Returns the path as a polyline: the ends of lines, and 32 chords of other segments.
std::vector<Vector3> polyline_of(const ToolPath& path) {
  std::vector<Vector3> points{pose_at(path, 0).translation()};
  for (const Segment& segment : path.segments) {
    const int chords = std::holds_alternative<Line>(segment) ? 1 : 32;
    for (int i = 1; i <= chords; ++i) {
      points.push_back(pose_at(segment, static_cast<double>(i) / chords).translation());
    }
  }
  return points;
}

}  // namespace

PathTrace trace_path(const Arm& arm, std::span<const Configuration> samples,
                     const FollowedPath& followed) {
  const ToolPath& path = followed.path;
  const std::vector<double>& path_parameters = followed.path_parameters;
  const Task& task = followed.task;
  if (path_parameters.empty() || path_parameters.size() > samples.size() || path.segments.empty() ||
      path.spans.size() != path.segments.size()) {
    throw Error("a trace along a path needs its segments, samples, and their path parameters");
  }
  check_path_parameters(path, path_parameters);
  constexpr std::size_t wanted = 3000;  // points; a chart does not resolve more
  const std::size_t parts = std::clamp<std::size_t>(wanted / samples.size(), 2, 16);
  PathTrace trace;
  trace.polyline = polyline_of(path);
  std::vector<Interval> intervals;
  double begin = 0;
  for (const Segment& segment : path.segments) {
    const Pose from = pose_at(segment, 0), to = pose_at(segment, 1);
    const double rotation_length =
        min_metres_per_radian * pose_difference(to, from).tail<3>().norm();
    const double length = length_of(segment);
    intervals.push_back({segment, begin, std::max(length, rotation_length)});
    trace.has_pure_rotation = trace.has_pure_rotation || length < rotation_length;
    begin += intervals.back().length;
  }
  std::size_t on = path.segments.size();  // the segment before
  for (std::size_t k = 1; k < path_parameters.size(); ++k) {
    for (const SegmentStep& step : split_at_segments(
             path, task, samples[k - 1], path_parameters[k - 1], samples[k], path_parameters[k])) {
      const Interval& interval = intervals[step.segment];
      const auto at = [&](double fraction, std::size_t number) {
        return measure(arm, step.q_a + fraction * (step.q_b - step.q_a),
                       std::lerp(step.s_a, step.s_b, fraction), number, interval, task);
      };
      if (step.segment != on) trace.points.push_back(at(0, 0));
      on = step.segment;
      const double from = trace.points.back().arc_length;
      for (std::size_t part = 1; part <= parts; ++part) {
        trace.points.push_back(at(static_cast<double>(part) / static_cast<double>(parts), k));
      }
      trace.steps.push_back(
          {from, trace.points.back().arc_length, measure_step(arm, path, task, step).bound});
    }
  }
  if (trace.points.empty()) {
    trace.points.push_back(measure(arm, samples.front(), 0, 0, intervals.front(), task));
  }
  const std::size_t reached = arrivals(path_parameters).size();
  for (std::size_t i = 0; i < reached; ++i) {
    trace.segment_ends.push_back(intervals[i].begin + intervals[i].length);
  }
  return trace;
}

}  // namespace beeline::internal
