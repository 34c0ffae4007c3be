#pragma once

#include <functional>

#include <tests/planning/motion_promises.h>

namespace beeline::testing {

/// A prismatic and a revolute joint, with limits of all kinds.
inline Arm two_joints() {
  Joint slide = composite_joint('P', "slide").front();
  Joint turning = composite_joint('R', "turning").front();
  slide.limits = {.lower = -1, .upper = 1, .velocity = 1, .acceleration = 2, .jerk = 6};
  turning.limits = {.lower = -20, .upper = 20, .velocity = 10, .acceleration = 2, .jerk = 6};
  return {"two", {slide, turning}};
}

/// Both coordinates as functions of time, at uneven times up to the end.
inline Trajectory along(const std::function<double(double)>& slide,
                        const std::function<double(double)>& turning, double end, int count = 40) {
  Trajectory trajectory;
  trajectory.joint_names = {"slide", "turning"};
  for (int k = 0; k <= count; ++k) {
    const double u = static_cast<double>(k) / count, t = end * u * (0.7 + 0.3 * u);
    trajectory.times.push_back(t);
    trajectory.positions.push_back((Configuration(2) << slide(t), turning(t)).finished());
  }
  return trajectory;
}

inline double nothing(double) { return 0; }

}  // namespace beeline::testing
