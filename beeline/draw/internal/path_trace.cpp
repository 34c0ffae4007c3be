#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/path_interval.h>
#include <beeline/draw/internal/path_trace.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/internal/scaled_blends.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline::internal {
namespace {

/// Projects a vector on the position rows of the task, for a tool at `pose`; in the world's axes.
Vector3 in_rows(const Task& task, const Pose& pose, const Vector3& v) {
  const Vector3 kept = internal::in_position_rows(task, pose, v);
  const bool in_tool_axes = task.frame == Frame::tool && task.positions() < 3;
  return in_tool_axes ? Vector3(pose.linear() * kept) : kept;
}

/// A segment with its range of arc length.
struct SegmentRange {
  const Segment& segment;
  double begin = 0, length = 0;
};

PathTrace::Point measure(const Arm& arm, const Configuration& q, double s, std::size_t step,
                         const SegmentRange& range, const Task& task) {
  const Pose pose = forward_kinematics(arm, q);
  if (const auto* line = std::get_if<Line>(&range.segment))
    s = internal::nearest_fraction(*line, pose, task);
  const Pose wanted = pose_at(range.segment, s);
  return {step, range.begin + s * range.length, task_deviation(task, wanted, pose),
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

/// Returns path parameters at which a waypoint may be: ends and middles of segments, and 32 points
/// of an arc, whose first waypoint may be anywhere.
std::vector<double> waypoint_candidates(const ToolPath& path) {
  std::vector<double> candidates{0};
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const int parts = std::holds_alternative<Arc>(path.segments[i]) ? 32 : 2;
    for (int k = 1; k <= parts; ++k) {
      candidates.push_back(static_cast<double>(i) + static_cast<double>(k) / parts);
    }
  }
  return candidates;
}

}  // namespace

PlacedWaypoints placed_waypoints(const FollowedPath& followed) {
  const ToolPath& path = followed.path;
  PlacedWaypoints placed;
  if (followed.waypoints.empty()) {
    for (std::size_t i = 0; i < path.segments.size(); ++i) {
      placed.poses.push_back(pose_at(path.segments[i], 1));
      placed.path_parameters.push_back(static_cast<double>(i + 1));
    }
    return placed;
  }
  constexpr double window = 2.5;  // segments: a line and the blends at its ends, or half of an arc
  const std::vector<double> candidates = waypoint_candidates(path);
  std::size_t next = 0;
  for (const Pose& waypoint : followed.waypoints) {
    const auto distance_at = [&](double s) {
      const Deviation off = task_deviation(followed.task, waypoint, pose_at(path, s));
      return off.position + metres_per_radian * off.orientation;
    };
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t best = next;
    for (std::size_t i = next; i < candidates.size(); ++i) {
      if (candidates[i] > candidates[next] + window) break;
      const double distance = distance_at(candidates[i]);
      if (!(distance < nearest)) continue;
      nearest = distance;
      best = i;
    }
    // Blended lines pass repeated poses as one.
    const bool again = !placed.poses.empty() && passed_as_one(waypoint, placed.poses.back());
    if (again && distance_at(placed.path_parameters.back()) < nearest) {
      placed.poses.push_back(waypoint);
      placed.path_parameters.push_back(placed.path_parameters.back());
      continue;
    }
    if (best >= candidates.size()) break;
    placed.poses.push_back(waypoint);
    placed.path_parameters.push_back(candidates[best]);
    next = best + 1;
  }
  return placed;
}

std::optional<double> time_at(const Trajectory& trajectory, const FollowedPath& followed,
                              double s) {
  const std::vector<double>& at = followed.path_parameters;
  for (std::size_t k = 0; k < at.size() && k < trajectory.size(); ++k) {
    if (at[k] < s - 1e-9) continue;
    if (k == 0 || at[k] <= s) return trajectory.times[k];
    const double part = std::clamp((s - at[k - 1]) / (at[k] - at[k - 1]), 0.0, 1.0);
    return trajectory.times[k - 1] + part * (trajectory.times[k] - trajectory.times[k - 1]);
  }
  return std::nullopt;
}

namespace {

/// Returns the sample at which a motion begins on its path: after its recovery, if the path was
/// followed with one.
std::size_t first_on_path(const Arm& arm, const Trajectory& trajectory,
                          const FollowedPath& followed) {
  const std::size_t first = begin_of_path(recovery_of(arm, trajectory));
  const std::vector<double>& at = followed.path_parameters;
  return first < at.size() && at[first] == 0 ? first : 0;
}

/// Returns the arc length at each waypoint that the motion reaches.
std::vector<double> waypoint_lengths(const Trajectory& trajectory, const FollowedPath& followed,
                                     const std::vector<SegmentRange>& ranges) {
  std::vector<double> lengths;
  for (const double s : placed_waypoints(followed).path_parameters) {
    if (!time_at(trajectory, followed, s)) continue;
    const std::size_t i = segment_at(followed.path, s);
    lengths.push_back(ranges[i].begin + (s - static_cast<double>(i)) * ranges[i].length);
  }
  return lengths;
}

}  // namespace

PathTrace trace_path(const Arm& arm, const Trajectory& trajectory, const FollowedPath& followed) {
  const ToolPath& path = followed.path;
  const std::vector<double>& path_parameters = followed.path_parameters;
  const Task& task = followed.task;
  if (path_parameters.empty() || path_parameters.size() > trajectory.size() ||
      path.segments.empty() || path.spans.size() != path.segments.size()) {
    throw Error("a trace along a path needs its segments, samples, and their path parameters");
  }
  check_path_parameters(path, path_parameters);
  constexpr std::size_t wanted = 3000;  // points; a chart does not resolve more
  const std::size_t parts = std::clamp<std::size_t>(wanted / trajectory.size(), 2, 16);
  PathTrace trace;
  trace.polyline = polyline_of(path);
  std::vector<SegmentRange> ranges;
  double begin = 0;
  for (const Segment& segment : path.segments) {
    const Pose from = pose_at(segment, 0), to = pose_at(segment, 1);
    const double rotation_length =
        min_metres_per_radian * pose_difference(to, from).tail<3>().norm();
    const double length = length_of(segment);
    ranges.push_back({segment, begin, std::max(length, rotation_length)});
    trace.has_pure_rotation = trace.has_pure_rotation || length < rotation_length;
    begin += ranges.back().length;
  }
  std::size_t on = path.segments.size();  // the previous segment
  const std::size_t first = first_on_path(arm, trajectory, followed);
  for (std::size_t k = first + 1; k < path_parameters.size(); ++k) {
    for (const PathInterval& part : path_intervals(arm, trajectory, k - 1, path, task,
                                                   path_parameters[k - 1], path_parameters[k])) {
      const SegmentRange& range = ranges[part.segment];
      const auto at = [&](double u, std::size_t number) {
        Configuration q(arm.dof());
        for (int i = 0; i < arm.dof(); ++i) {
          q[i] = part.interval.coordinates[static_cast<std::size_t>(i)](u);
        }
        return measure(arm, q, std::clamp(part.interval.s(u), 0.0, 1.0), number, range, task);
      };
      if (part.segment != on) trace.points.push_back(at(0, 0));
      on = part.segment;
      const double from = trace.points.back().arc_length;
      for (std::size_t i = 1; i <= parts; ++i) {
        trace.points.push_back(at(static_cast<double>(i) / static_cast<double>(parts), k));
      }
      const Deviation bound =
          interval_deviation(arm, path.segments[part.segment], task, part.interval).bound;
      trace.steps.push_back({from, trace.points.back().arc_length, bound});
    }
  }
  if (trace.points.empty()) {
    trace.points.push_back(measure(arm, trajectory.positions[first], 0, 0, ranges.front(), task));
  }
  const std::size_t reached = arrivals(path_parameters).size();
  for (std::size_t i = 0; i < reached; ++i) {
    trace.segment_ends.push_back(ranges[i].begin + ranges[i].length);
  }
  trace.waypoints = waypoint_lengths(trajectory, followed, ranges);
  return trace;
}

}  // namespace beeline::internal
