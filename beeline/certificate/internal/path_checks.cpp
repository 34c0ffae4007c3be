#include <algorithm>

#include <beeline/certificate/internal/matched_step.h>
#include <beeline/certificate/internal/path_checks.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_plane.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline::internal {
void check_task(const Arm& arm, const Segment& segment, const Task& task) {
  beeline::check_task(task);
  if (!std::holds_alternative<Line>(segment)) check_matched(arm, segment, task);
}

void check_task(const Arm& arm, const ToolPath& path, const Task& task) {
  if (path.segments.empty()) throw Error("a path needs segments");
  for (const Segment& segment : path.segments) check_task(arm, segment, task);
}

void check_route(const Arm& arm, const Route& route, const Task& task) {
  const std::size_t segments = route.path.segments.size();
  if (segments == 0 || route.stops.size() != segments || route.path.spans.size() != segments) {
    throw Error("a route needs segments, and a span and a stop for each; it has " +
                std::to_string(segments) + " segments, " + std::to_string(route.path.spans.size()) +
                " spans and " + std::to_string(route.stops.size()) + " stops");
  }
  const std::size_t names = route.path.names.size(), speeds = route.speeds.size();
  if ((names > 0 && names != segments) || (speeds > 0 && speeds != segments)) {
    throw Error("a route of " + std::to_string(segments) + " segments has " +
                std::to_string(names) + " names and " + std::to_string(speeds) +
                " speeds; it needs none, or one for each segment");
  }
  for (const double speed : route.speeds) {
    if (speed >= slowest_tool) continue;
    throw Error("the tool's speed on a segment must be at least " + number(slowest_tool) +
                " m/s, not " + number(speed));
  }
  check_task(arm, route.path, task);
}

void check_in_plane(const Arm& arm, const ToolPath& path, const std::optional<Task>& task) {
  const std::optional<ToolPlane> plane = ToolPlane::required(arm, task);
  if (!plane || path.segments.empty()) return;
  plane->check(pose_at(path.segments.front(), 0), "the path's beginning");
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const Segment& segment = path.segments[i];
    plane->check(pose_at(segment, 1), segment_end_name(path, i));
    // An arc with two ends in the plane may leave it between them.
    for (const double s : {0.25, 0.5, 0.75})
      plane->check(pose_at(segment, s), segment_name(path, i));
  }
}

std::string segment_end_name(const ToolPath& path, std::size_t i) {
  const bool is_waypoint = path.names.empty() && std::holds_alternative<Line>(path.segments[i]);
  return is_waypoint ? "waypoint " + std::to_string(i + 1) : "the end of " + segment_name(path, i);
}

void check_path_parameters(const ToolPath& path, std::span<const double> path_parameters) {
  const auto segments = static_cast<double>(path.segments.size());
  double before = 0;
  for (std::size_t k = 0; k < path_parameters.size(); ++k) {
    const double s = path_parameters[k];
    if (!(s >= before && s <= segments)) {
      throw Error("the path parameter of sample " + std::to_string(k + 1) + " is " + number(s) +
                  "; it must be from " + number(before) + " to " + number(segments));
    }
    before = s;
  }
}

bool all_lines(const ToolPath& path) {
  return std::all_of(path.segments.begin(), path.segments.end(),
                     [](const Segment& segment) { return std::holds_alternative<Line>(segment); });
}

bool all_rotate_about_z(const Arm& arm, const Segment& segment) {
  constexpr double tilt = 1e-9;
  if (!arm.rotates_about_z() || !rotates_about_z(segment)) return false;
  const Pose tool = forward_kinematics(arm, Configuration(Configuration::Zero(arm.dof())));
  const Rotation between = tool.linear() * pose_at(segment, 0).linear().transpose();
  return between.col(2).head<2>().norm() <= tilt && between(2, 2) > 0;
}

bool stands_still(const Segment& segment, const Task& task) {
  constexpr double still = 1e-9;  // metres and radians
  const Pose begin = pose_at(segment, 0);
  const auto at_begin = [&](double s) {
    return within(task_deviation(task, pose_at(segment, s), begin), {still, still});
  };
  return at_begin(1) && at_begin(0.5) && at_begin(0.25);
}

}  // namespace beeline::internal
