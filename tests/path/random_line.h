#pragma once

#include <beeline/kinematics/forward.h>

#include <tests/random.h>

namespace beeline::testing {

/// A configuration well inside the limits: within 70 % of their range, or of 2 pi to either side.
inline Configuration inner_configuration(Random& random, const Arm& arm) {
  Configuration q(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    const double lower = std::max(limits.lower, -3.1), upper = std::min(limits.upper, 3.1);
    q[k] = (lower + upper) / 2 + random.uniform(-0.35, 0.35) * (upper - lower);
  }
  return q;
}

/// A pose 5 to 30 cm and up to 0.5 rad away, as far as the arm can move that way at all: planar
/// arms in their plane (and scaled to their size), the SCARA about its axes.
inline Pose nearby_pose(Random& random, const Arm& arm, const Pose& from) {
  const double size = arm.planar() ? 5 : 1;
  Vector3 way = random.direction() * random.uniform(0.05, 0.3) * size;
  Vector3 turn = random.direction() * random.uniform(0, 0.5);
  if (arm.planar()) way.z() = 0;
  if (arm.planar() || arm.name() == "scara") turn = {0, 0, turn.z()};
  Pose to = from;
  to.translation() += way;
  to.linear() = so3_exp(turn) * from.linear();
  return to;
}

}  // namespace beeline::testing
