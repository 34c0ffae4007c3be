#include <algorithm>

#include <beeline/timing/internal/blended_path.h>

namespace beeline::internal {
namespace {

constexpr double least_speed = 0.1;  // in the middle of a blend, relative to the lines
constexpr double touching = 1e-12;   // of a line between two blends; shorter, they touch

void add_point(JointPath& path, double s, const Configuration& q, const Configuration& direction) {
  if (!path.s.empty() && s - path.s.back() <= touching) return;
  path.s.push_back(s);
  path.q.push_back(q);
  path.dq.push_back(direction);
  path.ddq.push_back(Configuration::Zero(q.size()));
}

Configuration direction_of(const Configuration& from, const Configuration& to) {
  return (to - from).normalized();
}

/// The path from a stop to the next one, with a blend of radius above 0 at each inner waypoint.
JointPath blended_path(const std::vector<Configuration>& waypoints,
                       const std::vector<double>& radii) {
  JointPath path;
  Configuration direction = direction_of(waypoints[0], waypoints[1]);
  add_point(path, 0, waypoints[0], direction);
  double s = 0, radius = 0;  // of the waypoint before
  for (std::size_t k = 1; k + 1 < waypoints.size(); ++k) {
    const JointBlend blend{waypoints[k - 1], waypoints[k], waypoints[k + 1], radii[k - 1]};
    s += (waypoints[k] - waypoints[k - 1]).norm() - radius - blend.radius;
    add_point(path, s, blend.begin(), direction);
    direction = direction_of(waypoints[k], waypoints[k + 1]);
    s += 2 * blend.radius;
    add_point(path, s, blend.end(), direction);
    radius = blend.radius;
  }
  s += (waypoints.back() - waypoints[waypoints.size() - 2]).norm() - radius;
  add_point(path, s, waypoints.back(), direction);
  return path;
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

std::vector<JointPath> blended_paths(const std::vector<Configuration>& waypoints,
                                     const std::vector<double>& radii) {
  std::vector<JointPath> paths;
  std::size_t first = 0;
  for (std::size_t k = 1; k < waypoints.size(); ++k) {
    const bool is_last = k + 1 == waypoints.size();
    if (!is_last && radii[k - 1] > 0) continue;
    const auto at = [](auto& list, std::size_t i) {
      return list.begin() + static_cast<std::ptrdiff_t>(i);
    };
    paths.push_back(blended_path({at(waypoints, first), at(waypoints, k + 1)},
                                 {at(radii, first), at(radii, k - 1)}));
    first = k;
  }
  return paths;
}

}  // namespace beeline::internal
