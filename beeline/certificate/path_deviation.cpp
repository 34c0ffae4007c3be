#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/line_step.h>
#include <beeline/certificate/path_deviation.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/internal/nearest_parameter.h>

namespace beeline {

void check_task(const Arm& arm, const Segment& segment, const Task& task) {
  check_task(task);
  if (!std::holds_alternative<Line>(segment)) check_matched(arm, segment, task);
}

void check_task(const Arm& arm, const ToolPath& path, const Task& task) {
  if (path.segments.empty()) throw Error("a path needs segments");
  for (const Segment& segment : path.segments) check_task(arm, segment, task);
}

void check_route(const Arm& arm, const Route& route, const Task& task) {
  const std::size_t segments = route.path.segments.size();
  if (segments == 0 || route.stops.size() != segments || route.path.spans.size() != segments) {
    throw Error(
        "a route needs segments, and for each its span and whether the arm stops behind it");
  }
  check_task(arm, route.path, task);
}

bool all_lines(const ToolPath& path) {
  return std::all_of(path.segments.begin(), path.segments.end(),
                     [](const Segment& segment) { return std::holds_alternative<Line>(segment); });
}

bool stands_still(const Segment& segment, const Task& task) {
  constexpr double nothing = 1e-9;
  const Pose begin = pose_at(segment, 0);
  const auto there = [&](double s) {
    return within(task_deviation(task, pose_at(segment, s), begin), {nothing, nothing});
  };
  return there(1) && there(0.5) && there(0.25);
}

Deviation deviation_from(const Segment& segment, double s, const Pose& pose, const Task& task) {
  if (const auto* line = std::get_if<Line>(&segment)) return deviation_from(*line, pose, task);
  return task_deviation(task, pose_at(segment, s), pose);
}

Deviation deviation_from(const ToolPath& path, double place, const Pose& pose, const Task& task) {
  const std::size_t i = segment_at(path, place);
  return deviation_from(path.segments[i], place - static_cast<double>(i), pose, task);
}

Deviation step_bound(const Arm& arm, const Segment& segment, const Task& task, const StepEnd& a,
                     const StepEnd& b) {
  const auto* line = std::get_if<Line>(&segment);
  if (line == nullptr) return matched_step_bound(arm, segment, task, a, b);
  return line_step_bound(arm, *line, task, a.q, b.q, a.off, b.off);
}

std::vector<SegmentStep> cut_at_segments(const ToolPath& path, const Task& task,
                                         const ConfigurationRef& q_a, double place_a,
                                         const ConfigurationRef& q_b, double place_b) {
  const auto last = static_cast<double>(path.segments.size() - 1);
  const auto first_segment = static_cast<std::size_t>(std::clamp(std::floor(place_a), 0.0, last));
  const std::size_t last_segment = std::max(first_segment, segment_at(path, place_b));
  if (first_segment == last_segment) {
    const auto done = static_cast<double>(first_segment);
    return {{first_segment, q_a, q_b, place_a - done, place_b - done}};
  }
  std::vector<SegmentStep> steps;
  std::vector<double> ways;
  double whole = 0;
  for (std::size_t i = first_segment; i <= last_segment; ++i) {
    const auto done = static_cast<double>(i);
    const double s_a = std::max(place_a - done, 0.0), s_b = std::min(place_b - done, 1.0);
    steps.push_back({i, {}, {}, s_a, s_b});
    ways.push_back(stands_still(path.segments[i], task) ? 0 : (s_b - s_a) * path.spans[i]);
    whole += ways.back();
  }
  double way = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto at = [&](double share) { return Configuration(q_a + share * (q_b - q_a)); };
    steps[i].q_a = i == 0 ? Configuration(q_a) : steps[i - 1].q_b;
    way += ways[i];
    steps[i].q_b = i + 1 == steps.size() ? Configuration(q_b) : at(whole > 0 ? way / whole : 0);
  }
  return steps;
}

MeasuredStep measured(const Arm& arm, const ToolPath& path, const Task& task,
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
      a.off,
      middle.off,
      b.off,
      {std::min(whole.position, halves.position), std::min(whole.orientation, halves.orientation)}};
}

void check_path_parameters(const ToolPath& path, std::span<const double> path_parameters) {
  const auto segments = static_cast<double>(path.segments.size());
  for (std::size_t k = 0; k < path_parameters.size(); ++k) {
    if (path_parameters[k] >= (k > 0 ? path_parameters[k - 1] : 0) &&
        path_parameters[k] <= segments)
      continue;
    throw Error("the place of sample " + std::to_string(k + 1) +
                " is not on the path, in order: " + number(path_parameters[k]));
  }
}

PathDeviation path_deviation(const Arm& arm, std::span<const Configuration> samples,
                             std::span<const double> path_parameters, const ToolPath& path,
                             const Task& task) {
  if (samples.empty() || samples.size() != path_parameters.size()) {
    throw Error("path_deviation needs samples, and a place on the path for each");
  }
  check_task(arm, path, task);
  check_path_parameters(path, path_parameters);
  PathDeviation result;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const Pose pose = forward_kinematics(arm, samples[k]);
    grow(result.sampled, deviation_from(path, path_parameters[k], pose, task));
    if (k == 0) continue;
    const auto steps = cut_at_segments(path, task, samples[k - 1], path_parameters[k - 1],
                                       samples[k], path_parameters[k]);
    for (const SegmentStep& step : steps) {
      const MeasuredStep seen = measured(arm, path, task, step);
      for (const Deviation& off : {seen.begin, seen.middle, seen.end}) grow(result.measured, off);
      grow(result.bound, seen.bound);
    }
  }
  grow(result.measured, result.sampled);
  grow(result.bound, result.sampled);
  return result;
}

std::vector<double> path_parameters_along(const Arm& arm, std::span<const Configuration> samples,
                                          const ToolPath& path,
                                          std::span<const std::size_t> arrivals, const Task& task) {
  if (samples.empty() || arrivals.size() > path.segments.size()) {
    throw Error("path parameters need samples, and an arrival for each segment of the path");
  }
  std::vector<double> path_parameters{0};
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    const auto end = static_cast<double>(i + 1);
    if (arrivals[i] + 1 < path_parameters.size() || arrivals[i] >= samples.size()) {
      throw Error("arrival " + std::to_string(i + 1) + " is not among the samples, in order");
    }
    for (std::size_t k = path_parameters.size(); k <= arrivals[i]; ++k) {
      const Pose pose = forward_kinematics(arm, samples[k]);
      path_parameters.push_back(
          nearest_parameter(path, task, pose, std::max(path_parameters.back(), end - 1), end));
    }
    path_parameters.back() = end;
  }
  path_parameters.resize(samples.size(), path_parameters.back());
  return path_parameters;
}

std::vector<std::size_t> arrivals(std::span<const double> path_parameters) {
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < path_parameters.size(); ++k) {
    while (path_parameters[k] >= static_cast<double>(all.size() + 1)) all.push_back(k);
  }
  return all;
}

}  // namespace beeline
