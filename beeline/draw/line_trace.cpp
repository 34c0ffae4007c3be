#include <algorithm>

#include <beeline/draw/line_trace.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/motion/straightness.h>

namespace beeline {
namespace {

double turn_of(const Pose& to, const Pose& from) {
  return pose_difference(to, from).tail<3>().norm();
}

/// A line with its place among the others.
struct Stretch {
  Line line;
  double begin = 0, length = 0;
  bool by_turn = false;
};

Stretch stretch_of(const Line& line, double begin) {
  const double way = (line.to.translation() - line.from.translation()).norm();
  const double turn = way_of_a_radian * turn_of(line.to, line.from);
  return {line, begin, std::max(way, turn), way < turn};
}

/// The part of a vector in the position rows that matter, for a tool at `pose`.
Vector3 in_rows(const Task& task, const Pose& pose, const Vector3& v) {
  const bool turned = task.frame == Frame::tool;
  Vector3 kept = turned ? Vector3(pose.linear().transpose() * v) : v;
  for (int i = 0; i < 3; ++i) {
    if (!task.rows[static_cast<std::size_t>(i)]) kept[i] = 0;
  }
  return turned ? Vector3(pose.linear() * kept) : kept;
}

LineTrace::Place place_of(const Arm& arm, const Configuration& q, std::size_t step,
                          const Stretch& stretch, const Task& task) {
  const Pose pose = forward_kinematics(arm, q);
  const Pose nearest = nearest_on(stretch.line, pose, task);
  const Line& line = stretch.line;
  const double done = stretch.by_turn ? way_of_a_radian * turn_of(nearest, line.from)
                                      : (nearest.translation() - line.from.translation()).norm();
  return {step, stretch.begin + std::min(done, stretch.length), task_deviation(task, nearest, pose),
          pose.translation(), in_rows(task, pose, pose.translation() - nearest.translation())};
}

}  // namespace

LineTrace trace_lines(const Arm& arm, std::span<const Configuration> samples,
                      const FollowedLines& lines) {
  if (samples.empty() || lines.waypoints.size() != lines.arrivals.size()) {
    throw Error("a trace along lines needs samples, and an arrival for each waypoint");
  }
  constexpr std::size_t wanted = 3000;  // places; a chart shows no more
  const std::size_t parts = std::clamp<std::size_t>(wanted / samples.size(), 2, 16);
  LineTrace trace;
  Pose from = forward_kinematics(arm, samples.front());
  trace.corners.push_back(from.translation());
  double begin = 0;
  std::size_t first = 0;
  for (std::size_t w = 0; w < lines.waypoints.size(); ++w) {
    if (lines.arrivals[w] < first || lines.arrivals[w] >= samples.size()) {
      throw Error("arrival " + std::to_string(w + 1) + " is not among the samples, in order");
    }
    const Stretch stretch = stretch_of({from, lines.waypoints[w]}, begin);
    LineTrace::Place before = place_of(arm, samples[first], 0, stretch, lines.task);
    trace.places.push_back(before);
    for (std::size_t k = first + 1; k <= lines.arrivals[w]; ++k) {
      for (std::size_t part = 1; part < parts; ++part) {
        const double share = static_cast<double>(part) / static_cast<double>(parts);
        trace.places.push_back(place_of(arm, samples[k - 1] + share * (samples[k] - samples[k - 1]),
                                        k, stretch, lines.task));
      }
      const LineTrace::Place now = place_of(arm, samples[k], k, stretch, lines.task);
      trace.places.push_back(now);
      trace.steps.push_back({before.way, now.way,
                             step_bound(arm, stretch.line, lines.task, samples[k - 1], samples[k],
                                        before.off, now.off)});
      before = now;
    }
    from = lines.waypoints[w];
    first = lines.arrivals[w];
    begin += stretch.length;
    trace.ends.push_back(begin);
    trace.corners.push_back(from.translation());
    trace.turns_only = trace.turns_only || (stretch.by_turn && stretch.length > 0);
  }
  return trace;
}

}  // namespace beeline
