#include <algorithm>

#include <beeline/timing/internal/blended_path.h>

namespace beeline::internal {
namespace {

constexpr double least_speed = 0.1;  // in the middle of a blend, relative to the lines
constexpr double touching = 1e-12;   // of a line between two blends; shorter, they touch

Configuration direction_of(const Configuration& from, const Configuration& to) {
  return (to - from).normalized();
}

void add_limit(ToolSpeeds& speeds, double end, double limit) {
  if (!speeds.limits.empty() && speeds.limits.back() == limit) {
    speeds.ends.back() = end;
    return;
  }
  speeds.ends.push_back(end);
  speeds.limits.push_back(limit);
}

/// Appends the part of `next` between two of its parameters, at parameter `begin` of `path`.
void append(LimitedPath& path, const LimitedPath& next, double from, double to, double begin) {
  add_point(path.path, begin, point_at(next.path, from));
  for (std::size_t k = 0; k < next.path.size(); ++k) {
    const double s = next.path.s[k];
    if (s - from <= touching || to - s <= touching) continue;
    add_point(path.path, begin + s - from,
              {next.path.q[k], next.path.dq[k], next.path.ddq[k], Configuration()});
  }
  add_point(path.path, begin + to - from, point_at(next.path, to));
  const ToolSpeeds& speeds = next.tool_speeds;
  for (std::size_t k = 0; k < speeds.ends.size(); ++k) {
    if (!(speeds.ends[k] > from)) continue;
    add_limit(path.tool_speeds, begin + std::min(speeds.ends[k], to) - from, speeds.limits[k]);
    if (speeds.ends[k] >= to) break;
  }
}

}  // namespace

Trajectory JointBlend::curve(const std::vector<std::string>& joint_names) const {
  const Configuration none = Configuration::Zero(at.size());
  return {joint_names,
          {0, 2 * radius},
          {begin(), end()},
          {direction_of(before, at), direction_of(at, after)},
          {none, none}};
}

JointPath straight_path(const Configuration& from, const Configuration& to) {
  const Configuration direction = direction_of(from, to), none = Configuration::Zero(from.size());
  return {{0, (to - from).norm()}, {from, to}, {direction, direction}, {none, none}};
}

void add_point(JointPath& path, double s, const PathPoint& point) {
  if (!path.s.empty() && s - path.s.back() <= touching) return;
  path.s.push_back(s);
  path.q.push_back(point.q);
  path.dq.push_back(point.dq);
  path.ddq.push_back(point.ddq);
}

PathPoint point_at(const JointPath& path, double s) {
  const auto next = std::upper_bound(path.s.begin() + 1, path.s.end() - 1, s);
  const auto k = static_cast<std::size_t>(next - path.s.begin()) - 1;
  const bool straight =
      path.dq[k] == path.dq[k + 1] && path.ddq[k].isZero(0) && path.ddq[k + 1].isZero(0);
  if (straight) {  // without the rounding of the polynomial, which counts in short steps
    const bool first_half = s - path.s[k] < path.s[k + 1] - s;
    const std::size_t near = first_half ? k : k + 1;  // exact at both ends
    return {path.q[near] + (s - path.s[near]) * path.dq[k], path.dq[k], path.ddq[k], path.ddq[k]};
  }
  return path_point(path, k, (s - path.s[k]) / (path.s[k + 1] - path.s[k]));
}

JointPath blend_between(const JointPath& before, const JointPath& after, double radius) {
  const PathPoint a = point_at(before, before.s.back() - radius);
  const PathPoint b = point_at(after, after.s.front() + radius);
  return {{0, 2 * radius}, {a.q, b.q}, {a.dq, b.dq}, {a.ddq, b.ddq}};
}

bool turns_back(const JointBlend& blend) {
  const Configuration sum =
      direction_of(blend.before, blend.at) + direction_of(blend.at, blend.after);
  return sum.norm() < 2 * least_speed;
}

JointBlend largest_blend(const std::vector<Configuration>& waypoints, std::size_t k, double most) {
  JointBlend blend{waypoints[k - 1], waypoints[k], waypoints[k + 1]};
  const double nearest =
      std::min((blend.at - blend.before).norm(), (blend.after - blend.at).norm());
  blend.radius = std::min(most, 0.5 * nearest);
  return blend;
}

std::vector<double> largest_blends(const std::vector<Configuration>& waypoints, double most) {
  std::vector<double> radii;
  for (std::size_t k = 1; k + 1 < waypoints.size(); ++k) {
    const JointBlend blend = largest_blend(waypoints, k, most);
    radii.push_back(blend.radius < least_blend || turns_back(blend) ? 0 : blend.radius);
  }
  return radii;
}

std::vector<double> with_stops_below(double radius, std::vector<double> radii) {
  for (double& here : radii) {
    if (here < radius) here = 0;
  }
  return radii;
}

std::vector<LimitedPath> joined_paths(const std::vector<LimitedPath>& paths,
                                      const std::vector<double>& radii) {
  std::vector<LimitedPath> joined;
  double s = 0, before = 0;  // the radius of the blend before
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const double after = i < radii.size() ? radii[i] : 0;
    const JointPath& path = paths[i].path;
    if (before == 0) {
      LimitedPath& begun = joined.emplace_back();
      begun.tool_speeds.ends.clear();
      begun.tool_speeds.limits.clear();
      s = 0;
    }
    append(joined.back(), paths[i], path.s.front() + before, path.s.back() - after, s);
    s += path.s.back() - path.s.front() - before - after;
    if (after > 0) {
      s += 2 * after;
      const double limit =
          std::min(paths[i].tool_speeds.limits.back(), paths[i + 1].tool_speeds.limits.front());
      add_limit(joined.back().tool_speeds, s, limit);
    }
    before = after;
  }
  return joined;
}

std::vector<JointPath> blended_paths(const std::vector<Configuration>& waypoints,
                                     const std::vector<double>& radii) {
  std::vector<LimitedPath> straight;
  for (std::size_t k = 1; k < waypoints.size(); ++k) {
    straight.push_back({straight_path(waypoints[k - 1], waypoints[k]), {}});
  }
  std::vector<JointPath> paths;
  for (LimitedPath& joined : joined_paths(straight, radii)) paths.push_back(std::move(joined.path));
  return paths;
}

}  // namespace beeline::internal
