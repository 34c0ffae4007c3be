#pragma once

#include <beeline/math/polynomial.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The motion of a coordinate between sample k and the next, of u = (t - times[k]) / h from 0 to 1,
/// h the time between the two samples: see Interpolation.
inline Polynomial interval_polynomial(const Trajectory& trajectory, std::size_t k,
                                      Eigen::Index coordinate) {
  const double h = trajectory.times[k + 1] - trajectory.times[k];
  const auto at = [&](const std::vector<Configuration>& column, std::size_t sample) {
    return column[sample][coordinate];
  };
  const double p0 = at(trajectory.positions, k), p1 = at(trajectory.positions, k + 1);
  if (trajectory.velocities.empty()) return line_between(p0, p1);
  const double d0 = h * at(trajectory.velocities, k), d1 = h * at(trajectory.velocities, k + 1);
  if (trajectory.accelerations.empty()) return cubic_between(p0, p1, d0, d1);
  return quintic_between(p0, p1, d0, d1, h * h * at(trajectory.accelerations, k),
                         h * h * at(trajectory.accelerations, k + 1));
}

/// The same for all coordinates.
inline std::vector<Polynomial> interval_polynomials(const Trajectory& trajectory, std::size_t k) {
  std::vector<Polynomial> all;
  for (Eigen::Index i = 0; i < trajectory.positions[k].size(); ++i) {
    all.push_back(interval_polynomial(trajectory, k, i));
  }
  return all;
}

/// Removes the columns that the interpolation does not have.
inline void keep_columns(Trajectory& trajectory, Interpolation interpolation) {
  if (interpolation != Interpolation::quintic) trajectory.accelerations.clear();
  if (interpolation == Interpolation::linear) trajectory.velocities.clear();
}

/// The highest order of a bounded derivative, 1, 2 or 3: all lower derivatives are continuous.
constexpr int bounded_order(Interpolation interpolation) {
  return 1 + static_cast<int>(interpolation);
}

/// The derivative of the order, 1 to 3, with respect to time, of u.
inline Polynomial time_derivative(Polynomial p, int order, double h) {
  for (int n = 0; n < order; ++n) {
    p = p.derivative();
    for (double& c : p.c) c /= h;
  }
  return p;
}

}  // namespace beeline::internal
