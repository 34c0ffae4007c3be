#include "path_argument.h"

#include <fmt/format.h>

#include <beeline/error.h>
#include <beeline/path/blend.h>

#include "command/streams.h"

namespace beeline::command {
namespace {

/// The poses at which the segments of a path begin, and the last pose. A spline has no segment to a
/// pose that repeats the one before it.
std::vector<std::size_t> segment_ends(PathKind kind, std::span<const Pose> poses) {
  const std::size_t stride = kind == PathKind::arc ? 2 : 1;  // poses of a segment
  std::vector<std::size_t> ends;
  for (std::size_t k = 0; k < poses.size(); k += stride) {
    if (kind == PathKind::spline && k > 0 && repeats(poses[k], poses[ends.back()])) continue;
    ends.push_back(k);
  }
  if (ends.size() == 1) ends.push_back(poses.size() - 1);
  return ends;
}

/// The names of the segments with the numbers of the file's waypoints between which they are: "line
/// 2 of 3 (waypoint 1 to 2)". The first waypoint of a path with `start_first` is the start.
std::vector<std::string> segment_names(PathKind kind, std::span<const Pose> poses,
                                       bool start_first) {
  const std::vector<std::size_t> ends = segment_ends(kind, poses);
  const std::size_t segments = ends.size() - 1;
  const auto number_of = [&](std::size_t pose) {
    return std::to_string(start_first ? pose : pose + 1);
  };
  std::vector<std::string> names;
  for (std::size_t i = 0; i < segments; ++i) {
    const bool from_start = start_first && i == 0;
    names.push_back(fmt::format("{} {} of {} ({} to {}{})",
                                kind == PathKind::line ? "line" : "segment", i + 1, segments,
                                from_start ? "start" : "waypoint " + number_of(ends[i]),
                                from_start ? "waypoint " : "", number_of(ends[i + 1])));
  }
  return names;
}

/// Warns of the waypoints at which the tool stops in spite of --blend.
void warn_of_stops(const BlendedPath& blended, bool start_first) {
  for (std::size_t i = 0; i < blended.blends.size(); ++i) {
    if (!blended.blends[i].sharp) continue;
    warn(fmt::format("the tool turns back at waypoint {}, where no blend is possible: it stops",
                     start_first ? i + 1 : i + 2));
  }
}

}  // namespace

std::vector<Option> PathArgument::options(const std::vector<std::string>& methods) {
  return {Option("--path KIND",
                 "line; screw: a screw motion from pose to pose; arc: circular arcs, each through "
                 "two more poses, of which the first gives a position only; spline: one smooth "
                 "curve through all poses.",
                 &kind, {.choices = path_kind_names(), .methods = methods}),
          Option("--blend METRES",
                 "Blend the corners of straight lines, so that the tool passes them without a "
                 "stop, at most this far from the corner (and 5 rad for each metre); 1e-4 or more.",
                 &blend, {.range = above_zero, .methods = methods})};
}

bool PathArgument::straight() const { return path_kind_named(kind) == PathKind::line && !blend; }

Route PathArgument::through(std::span<const Pose> poses) const { return route(poses, false); }

/// The path through the poses, of which the first may be the start, before the file's.
Route PathArgument::route(std::span<const Pose> poses, bool start_first) const {
  const PathKind path = path_kind_named(kind);
  if (blend && path != PathKind::line) throw Error("--blend requires --path line");
  if (!blend) {
    Route route = route_of(straight() ? lines_through(poses) : path_through(poses, path), path);
    route.path.names = segment_names(path, poses, start_first);
    return route;
  }
  BlendedPath blended = blended_lines(poses, {*blend, *blend / metres_per_radian});
  warn_of_stops(blended, start_first);
  blended.path.names = blend_names(blended, {"waypoint", start_first});
  return route_of(blended);
}

Route PathArgument::from(const Pose& tool, std::vector<Pose> poses, const Task& task) const {
  constexpr Deviation rounding{1e-9, 1e-9};
  constexpr Deviation same{1e-5, 1e-5};  // the effect of joint values typed with six digits
  const Deviation distance = task_deviation(task, poses.front(), tool);
  if (!straight() && within(distance, same)) {
    if (!within(distance, rounding)) poses.front() = tool;
    return through(poses);
  }
  if (path_kind_named(kind) == PathKind::arc && poses.size() % 2 == 1) {
    throw Error("the tool begins " + deviation_text(distance) +
                " away from the first pose, so that its pose counts as one more; arcs then need an "
                "even number of poses in the file");
  }
  poses.insert(poses.begin(), tool);
  return route(poses, true);
}

}  // namespace beeline::command
