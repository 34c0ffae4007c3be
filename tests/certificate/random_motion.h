#pragma once

#include <beeline/trajectory/trajectory.h>

#include <tests/random.h>

namespace beeline::testing {

/// A trajectory of random samples, `step` apart, whose columns mean the interpolation.
inline Trajectory random_motion(Random& random, const Arm& arm, Interpolation interpolation,
                                int samples, double step) {
  Trajectory motion{arm.joint_names(), {}, {}, {}, {}};
  Configuration q = random.configuration(arm);
  double time = random.uniform(-1, 1);
  const auto any = [&](double size) {
    return Configuration(
        Configuration::NullaryExpr(arm.dof(), [&] { return random.uniform(-size, size); }));
  };
  for (int i = 0; i < samples; ++i) {
    motion.times.push_back(time);
    motion.positions.push_back(q);
    const double h = random.uniform(0.1, 0.5);
    if (interpolation != Interpolation::linear) motion.velocities.push_back(any(step / h));
    if (interpolation == Interpolation::quintic) {
      motion.accelerations.push_back(any(step / (h * h)));
    }
    time += h;
    q += any(step);
  }
  return motion;
}

inline Interpolation random_interpolation(Random& random) {
  return static_cast<Interpolation>(random.integer(0, 2));
}

}  // namespace beeline::testing
