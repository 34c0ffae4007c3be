#pragma once

#include <algorithm>
#include <cmath>

#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>

#include <tests/random.h>

namespace beeline::testing {

inline std::vector<Configuration> random_waypoints(Random& random, int joints, int count) {
  std::vector<Configuration> waypoints;
  for (int k = 0; k < count; ++k) {
    Configuration& q = waypoints.emplace_back(joints);
    for (double& value : q) value = random.uniform(-1.5, 1.5);
  }
  return waypoints;
}

/// The spline through random waypoints, by chord length.
inline JointPath random_path(Random& random, int joints, int count) {
  const auto waypoints = random_waypoints(random, joints, count);
  return refined(joint_spline(waypoints, chord_length(waypoints)));
}

/// Typical of industrial arms, without jerk limits.
inline PathLimits random_limits(Random& random, int joints) {
  PathLimits limits;
  limits.velocity = limits.acceleration = limits.jerk = Configuration(joints);
  for (int i = 0; i < joints; ++i) {
    limits.velocity[i] = random.uniform(1, 3.2);
    limits.acceleration[i] = random.uniform(2, 20);
    limits.jerk[i] = Limits::none;
  }
  return limits;
}

/// The largest fraction of a limit of velocity or acceleration at ten points of every step.
inline double largest_fraction(const JointPath& path, const PathLimits& limits,
                               const TimeScaling& scaling) {
  double largest = 0;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    const double x = scaling.speed[k] * scaling.speed[k],
                 y = scaling.speed[k + 1] * scaling.speed[k + 1];
    const double u = (y - x) / (2 * (path.s[k + 1] - path.s[k]));
    for (int part = 0; part <= 10; ++part) {
      const double b = x + part / 10.0 * (y - x);
      const PathPoint point = path_point(path, k, part / 10.0);
      const Configuration v = point.dq * std::sqrt(b), a = point.dq * u + point.ddq * b;
      largest = std::max({largest, v.cwiseQuotient(limits.velocity).lpNorm<Eigen::Infinity>(),
                          a.cwiseQuotient(limits.acceleration).lpNorm<Eigen::Infinity>()});
    }
  }
  return largest;
}

inline JointPath reversed(const JointPath& path) {
  JointPath back = path;
  const std::size_t last = path.size() - 1;
  for (std::size_t k = 0; k <= last; ++k) {
    back.s[k] = path.s[last] - path.s[last - k];
    back.q[k] = path.q[last - k];
    back.dq[k] = -path.dq[last - k];
    back.ddq[k] = path.ddq[last - k];
  }
  return back;
}

}  // namespace beeline::testing
