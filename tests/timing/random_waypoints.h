#pragma once

#include <beeline/model/arm.h>
#include <beeline/trajectory/trajectory.h>

#include <tests/random.h>

namespace beeline::testing {

/// Waypoints well within the arm's limits, a second apart.
inline Trajectory random_waypoints(Random& random, const Arm& arm, int count) {
  Trajectory given{arm.joint_names(), {}, {}, {}, {}};
  const Configuration middle = middle_configuration(arm);
  for (int k = 0; k < count; ++k) {
    given.times.push_back(k);
    given.positions.push_back(middle + 0.2 * (random.configuration(arm) - middle));
  }
  return given;
}

}  // namespace beeline::testing
