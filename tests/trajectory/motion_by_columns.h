#pragma once

#include <cmath>
#include <vector>

#include <beeline/trajectory/trajectory.h>

#include <tests/random.h>

/// The motion that the columns of a trajectory mean, evaluated apart from the library.
namespace beeline::testing {

/// The derivative of an order (0: the value) of coordinate i at the fraction u of the interval
/// after sample k: by the control points of Bezier's form and de Casteljau's algorithm (Farin,
/// *Curves and Surfaces for CAGD*, chapter 5).
inline double derivative_between(const Trajectory& motion, std::size_t k, Eigen::Index i, double u,
                                 int order) {
  const double h = motion.times[k + 1] - motion.times[k];
  const double p0 = motion.positions[k][i], p1 = motion.positions[k + 1][i];
  std::vector<double> points{p0, p1};
  if (!motion.velocities.empty()) {
    const double v0 = motion.velocities[k][i], v1 = motion.velocities[k + 1][i];
    if (motion.accelerations.empty()) {
      points = {p0, p0 + h * v0 / 3, p1 - h * v1 / 3, p1};
    } else {
      const double a0 = motion.accelerations[k][i], a1 = motion.accelerations[k + 1][i];
      points = {p0,
                p0 + h * v0 / 5,
                p0 + 2 * h * v0 / 5 + h * h * a0 / 20,
                p1 - 2 * h * v1 / 5 + h * h * a1 / 20,
                p1 - h * v1 / 5,
                p1};
    }
  }
  double factor = 1;
  for (int n = 0; n < order; ++n) {
    if (points.size() < 2) return 0;
    factor *= static_cast<double>(points.size() - 1) / h;
    for (std::size_t j = 0; j + 1 < points.size(); ++j) points[j] = points[j + 1] - points[j];
    points.pop_back();
  }
  while (points.size() > 1) {
    for (std::size_t j = 0; j + 1 < points.size(); ++j) {
      points[j] = std::lerp(points[j], points[j + 1], u);
    }
    points.pop_back();
  }
  return factor * points.front();
}

/// All coordinates.
inline Configuration derivatives_between(const Trajectory& motion, std::size_t k, double u,
                                         int order) {
  Configuration all(motion.positions[k].size());
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    all[i] = derivative_between(motion, k, i, u, order);
  }
  return all;
}

/// The rounding error of that derivative, of coordinates of a few radians.
inline double rounding_of_derivative(const Trajectory& motion, std::size_t k, int order) {
  return 1e-13 / std::pow(motion.times[k + 1] - motion.times[k], order);
}

/// A motion with random columns at uneven times.
inline Trajectory random_motion(Random& random, const std::vector<std::string>& names, int samples,
                                Interpolation interpolation) {
  Trajectory motion;
  motion.joint_names = names;
  const auto values = [&](double size) {
    Configuration q(static_cast<Eigen::Index>(names.size()));
    for (double& value : q) value = random.uniform(-size, size);
    return q;
  };
  double t = 0;
  Configuration q = values(1);
  for (int k = 0; k < samples; ++k) {
    motion.times.push_back(t);
    motion.positions.push_back(q);
    if (interpolation != Interpolation::linear) motion.velocities.push_back(values(1));
    if (interpolation == Interpolation::quintic) motion.accelerations.push_back(values(5));
    const double h = random.uniform(0.01, 0.3);
    t += h;
    q += h * values(2);
  }
  return motion;
}

constexpr Interpolation interpolations[] = {Interpolation::linear, Interpolation::cubic,
                                            Interpolation::quintic};

}  // namespace beeline::testing
