#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <beeline/trajectory/trajectory.h>

#include <tests/random.h>

namespace beeline::testing {

/// Any number of joints and samples, of any size, with velocities and accelerations or without.
inline Trajectory random_trajectory(Random& random, std::vector<std::string> names = {}) {
  Trajectory trajectory;
  if (names.empty()) {
    for (int i = random.integer(1, 8); i > 0; --i) names.push_back("joint" + std::to_string(i));
  }
  trajectory.joint_names = names;
  const int samples = random.integer(1, 20);
  const bool velocities = random.integer(0, 1) == 0;
  const bool accelerations = velocities && random.integer(0, 1) == 0;
  const auto values = [&] {
    Configuration q(static_cast<Eigen::Index>(names.size()));
    for (double& value : q) value = random.uniform(-1, 1) * std::pow(10, random.integer(-20, 20));
    return q;
  };
  double time = random.uniform(-1, 1);
  for (int k = 0; k < samples; ++k) {
    trajectory.times.push_back(time);
    time += random.uniform(1e-6, 1);
    trajectory.positions.push_back(values());
    if (velocities) trajectory.velocities.push_back(values());
    if (accelerations) trajectory.accelerations.push_back(values());
  }
  return trajectory;
}

/// The trajectory with times of whole nanoseconds, as files of ROS hold them.
inline Trajectory in_nanoseconds(Trajectory trajectory) {
  for (double& time : trajectory.times) time = std::round(time * 1e9) / 1e9;
  return trajectory;
}

/// The same to the last bit.
inline bool same(const Trajectory& a, const Trajectory& b) {
  return a.joint_names == b.joint_names && a.times == b.times && a.positions == b.positions &&
         a.velocities == b.velocities && a.accelerations == b.accelerations;
}

}  // namespace beeline::testing
