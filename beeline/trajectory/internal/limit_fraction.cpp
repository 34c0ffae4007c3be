#include <algorithm>
#include <cmath>

#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/limit_fraction.h>
#include <beeline/trajectory/internal/mean_derivative.h>

namespace beeline::internal {
namespace {

double limit_of(const Limits& limits, int order) {
  return order == 1 ? limits.velocity : order == 2 ? limits.acceleration : limits.jerk;
}

/// Returns the exact fraction of the limit that the derivative's polynomial uses from sample k to
/// the next, or 0 if it is at most `known`.
double exact_fraction(const Trajectory& trajectory, std::size_t k, int coordinate, int order,
                      double limit, double known) {
  const double h = trajectory.times[k + 1] - trajectory.times[k];
  const Polynomial p = time_derivative(interval_polynomial(trajectory, k, coordinate), order, h);
  const auto fraction_of = [limit](const Extremes& of) {
    return std::max(-of.smallest, of.largest) / limit;
  };
  return fraction_of(enclosure(p)) > known ? fraction_of(extremes(p)) : 0;
}

/// Takes the interval after sample k into account.
void take_interval(CoordinateFraction& largest, std::span<const Limits> limits,
                   const Trajectory& trajectory, std::size_t k, int order) {
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const double limit = limit_of(limits[i], order);
    if (!(limit < Limits::none)) continue;
    const int coordinate = static_cast<int>(i);
    const double fraction =
        largest.exact ? exact_fraction(trajectory, k, coordinate, order, limit, largest.fraction)
                      : needed_derivative(trajectory, k, coordinate, order) / limit;
    if (!(fraction > largest.fraction)) continue;
    // A divided difference is of the jump at the next sample.
    largest = {fraction, coordinate, largest.exact ? k : k + 1, largest.exact};
  }
}

constexpr std::size_t batch = 64;  // samples, of less than a microsecond

/// Returns the largest distance from the middle of the range, over half of it, from sample k to the
/// next, or 0 if it is at most `known`.
double range_fraction(const Trajectory& trajectory, std::size_t k, int coordinate,
                      const Limits& limits, double known) {
  const auto fraction_of = [&](double q) {
    return std::abs(position_in_range(q, limits.lower, limits.upper));
  };
  const double at_sample = fraction_of(trajectory.positions[k][coordinate]);
  if (k + 1 == trajectory.size() || trajectory.velocities.empty()) return at_sample;
  const auto largest = [&](const Extremes& of) {
    return std::max(fraction_of(of.smallest), fraction_of(of.largest));
  };
  const Polynomial p = interval_polynomial(trajectory, k, coordinate);
  return largest(enclosure(p)) > known ? std::max(at_sample, largest(extremes(p))) : 0;
}

}  // namespace

std::vector<Limits> motion_limits_of(const Arm& arm) {
  std::vector<Limits> limits;
  for (const Limits& known : arm.limits()) limits.push_back(motion_limits(known));
  return limits;
}

CoordinateFraction limit_fraction(std::span<const Limits> limits, const Trajectory& trajectory,
                                  int order, BudgetMeter& budget) {
  CoordinateFraction largest;
  largest.exact = order <= bounded_order(trajectory.interpolation());
  for (std::size_t k = 0; k + 1 < trajectory.size(); ++k) {
    if (k % batch == 0 && budget.ended(batch)) break;
    take_interval(largest, limits, trajectory, k, order);
  }
  return largest;
}

CoordinateFraction range_fraction(std::span<const Limits> limits, const Trajectory& trajectory,
                                  BudgetMeter& budget) {
  CoordinateFraction largest;
  largest.coordinate = -1;
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    if (k % batch == 0 && budget.ended(batch)) break;
    for (std::size_t i = 0; i < limits.size(); ++i) {
      const double half = (limits[i].upper - limits[i].lower) / 2;
      if (!(half > 0 && half < Limits::none)) continue;
      const int coordinate = static_cast<int>(i);
      const double fraction =
          range_fraction(trajectory, k, coordinate, limits[i], largest.fraction);
      if (fraction > largest.fraction || largest.coordinate < 0) {
        largest = {fraction, coordinate, k};
      }
    }
  }
  return largest;
}

std::vector<double> limit_fractions(std::span<const Limits> limits, const Trajectory& trajectory,
                                    int order, BudgetMeter& budget) {
  std::vector<double> fractions(trajectory.size() - 1, 0.0);
  if (order > bounded_order(trajectory.interpolation())) return fractions;
  for (std::size_t k = 0; k < fractions.size(); ++k) {
    if (k % batch == 0 && budget.ended(0)) break;
    CoordinateFraction largest;
    take_interval(largest, limits, trajectory, k, order);
    fractions[k] = largest.fraction;
  }
  return fractions;
}

}  // namespace beeline::internal
