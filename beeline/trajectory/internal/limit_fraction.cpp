#include <algorithm>

#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/limit_fraction.h>
#include <beeline/trajectory/internal/mean_derivative.h>

namespace beeline::internal {
namespace {

double limit_of(const Limits& limits, int order) {
  return order == 1 ? limits.velocity : order == 2 ? limits.acceleration : limits.jerk;
}

/// By the trajectory's polynomials: exact.
void take_interval(CoordinateFraction& largest, const Trajectory& trajectory, std::size_t k, int i,
                   int order, double limit) {
  const double h = trajectory.times[k + 1] - trajectory.times[k];
  const Polynomial p = time_derivative(interval_polynomial(trajectory, k, i), order, h);
  const auto fraction_of = [limit](const Extremes& of) {
    return std::max(-of.smallest, of.largest) / limit;
  };
  if (!(fraction_of(enclosure(p)) > largest.fraction)) return;
  const double fraction = fraction_of(extremes(p));
  if (fraction > largest.fraction) largest = {fraction, i, k, true};
}

}  // namespace

CoordinateFraction limit_fraction(std::span<const Limits> limits, const Trajectory& trajectory,
                                  int order) {
  CoordinateFraction largest;
  largest.exact = order <= bounded_order(trajectory.interpolation());
  for (std::size_t k = 0; k + 1 < trajectory.size(); ++k) {
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const double limit = limit_of(limits[i], order);
      const int coordinate = static_cast<int>(i);
      if (!(limit < Limits::none)) continue;
      if (largest.exact) {
        take_interval(largest, trajectory, k, coordinate, order, limit);
        continue;
      }
      const double fraction = mean_derivative(trajectory, k, coordinate, order) / limit;
      if (fraction > largest.fraction) largest = {fraction, coordinate, k, false};
    }
  }
  return largest;
}

std::vector<double> limit_fractions(std::span<const Limits> limits, const Trajectory& trajectory,
                                    int order) {
  std::vector<double> fractions(trajectory.size() - 1, 0.0);
  if (order > bounded_order(trajectory.interpolation())) return fractions;
  for (std::size_t k = 0; k < fractions.size(); ++k) {
    CoordinateFraction largest;
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const double limit = limit_of(limits[i], order);
      if (!(limit < Limits::none)) continue;
      take_interval(largest, trajectory, k, static_cast<int>(i), order, limit);
    }
    fractions[k] = largest.fraction;
  }
  return fractions;
}

}  // namespace beeline::internal
