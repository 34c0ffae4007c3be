#include <beeline/planning/internal/blended_path.h>

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

}  // namespace beeline::internal
