#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/path/internal/checked_poses.h>
#include <beeline/path/internal/tool_spline.h>
#include <beeline/path/tool_path.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<PathKind> kind_names("path");

/// The parts of a path of one kind through poses, `step` of them after the first for each.
ToolPath segments_through(const std::vector<Pose>& poses, PathKind kind) {
  const std::size_t step = kind == PathKind::arc ? 2 : 1;
  ToolPath path;
  for (std::size_t i = 0; i + step < poses.size(); i += step) {
    const Pose &from = poses[i], &middle = poses[i + 1], &to = poses[i + step];
    const bool rests = repeats(to, from) && repeats(middle, from);
    if (kind == PathKind::line || rests) {
      path.segments.emplace_back(Line{from, to});
      path.spans.push_back(span_of({from, to}));
      continue;
    }
    path.segments.push_back(kind == PathKind::screw
                                ? Segment(ScrewLine{from, to})
                                : Segment(arc_through(from, middle.translation(), to)));
    path.spans.push_back(std::max(length_of(path.segments.back()), span_of({from, to})));
  }
  return path;
}

}  // namespace

std::string name(PathKind value) { return kind_names.of(value); }

std::vector<std::string> path_kind_names() { return kind_names.all(); }

PathKind path_kind_named(std::string_view name) { return kind_names.named(name); }

Route route_of(ToolPath path, PathKind kind) {
  const std::size_t segments = path.segments.size();
  std::vector<bool> stops(segments, true);
  for (std::size_t i = 0; i + 1 < segments && kind == PathKind::spline; ++i) {
    stops[i] = corner_at(path, static_cast<double>(i + 1));
  }
  return {std::move(path), std::move(stops)};
}

double span_of(const Line& line) {
  const Twist whole = pose_difference(line.to, line.from);
  return std::max(whole.head<3>().norm(), min_metres_per_radian * whole.tail<3>().norm());
}

std::string segment_name(const ToolPath& path, std::size_t i) {
  if (!path.names.empty()) return path.names.at(i);
  return (std::holds_alternative<Line>(path.segments.at(i)) ? "line " : "segment ") +
         std::to_string(i + 1);
}

std::size_t segment_at(const ToolPath& path, double s) {
  const double last = static_cast<double>(path.segments.size() - 1);
  return static_cast<std::size_t>(std::clamp(std::ceil(s) - 1, 0.0, last));
}

Pose pose_at(const ToolPath& path, double s) {
  const std::size_t i = segment_at(path, s);
  return pose_at(path.segments[i], s - static_cast<double>(i));
}

double span_to(const ToolPath& path, double s) {
  const std::size_t last = segment_at(path, s);
  double span = (s - static_cast<double>(last)) * path.spans[last];
  for (std::size_t i = 0; i < last; ++i) span += path.spans[i];
  return span;
}

bool corner_at(const ToolPath& path, double s) {
  constexpr double rounding = 1e-6;  // of the velocity
  const auto i = static_cast<std::size_t>(s);
  if (s != std::floor(s) || i == 0 || i >= path.segments.size()) return false;
  const Twist before = motion_at(path.segments[i - 1], 1).velocity / path.spans[i - 1];
  const Twist after = motion_at(path.segments[i], 0).velocity / path.spans[i];
  return !((after - before).norm() <= rounding * before.norm());
}

ToolPath reversed(const ToolPath& path) {
  ToolPath back{{}, {path.spans.rbegin(), path.spans.rend()}};
  for (auto segment = path.segments.rbegin(); segment != path.segments.rend(); ++segment) {
    back.segments.push_back(reversed(*segment));
  }
  return back;
}

bool repeats(const Pose& pose, const Pose& before) {
  constexpr double identical = 1e-12;  // metres, radians
  return !(pose_difference(pose, before).norm() > identical);
}

ToolPath lines_through(std::span<const Pose> given) {
  if (given.size() < 2)
    throw Error("lines need at least two poses, not " + std::to_string(given.size()));
  return segments_through(internal::checked_poses(given), PathKind::line);
}

ToolPath path_through(std::span<const Pose> given, PathKind kind, const SplineEnds& ends) {
  if (given.size() < 2) throw Error("a path needs at least two poses");
  std::vector<Pose> poses = internal::checked_poses(given);
  if (kind == PathKind::spline) {
    poses.erase(
        std::unique(poses.begin(), poses.end(),
                    [](const Pose& before, const Pose& pose) { return repeats(pose, before); }),
        poses.end());
    if (poses.size() > 1) return internal::spline_through(poses, ends);
    return segments_through({poses.front(), poses.front()}, PathKind::line);
  }
  if (kind == PathKind::arc && poses.size() % 2 == 0) {
    throw Error(
        "arcs need an odd number of poses: the first, and for each arc a position on it and its "
        "last pose; got " +
        std::to_string(poses.size()));
  }
  return segments_through(poses, kind);
}

}  // namespace beeline
