#pragma once

#include <span>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The limits of a motion of the arm, of each coordinate: see motion_limits().
std::vector<Limits> motion_limits_of(const Arm& arm);

/// The largest fraction of the limits of one kind that a trajectory uses, and where.
struct CoordinateFraction {
  double fraction = 0;
  int coordinate = 0;
  std::size_t sample = 0;  ///< the one before it
  bool exact = true;       ///< see LimitFraction
};

/// Computes it for the derivative of an order from 1 (velocity) to 3 (jerk). `limits`: of each
/// column of the trajectory; infinite ones count as not used. The largest so far where the budget
/// ends it.
CoordinateFraction limit_fraction(std::span<const Limits> limits, const Trajectory& trajectory,
                                  int order, BudgetMeter& budget = unlimited());

/// The largest fraction of the limits of that order between each two samples; 0 for an order that
/// the interpolation does not bound, and where the budget ends it.
std::vector<double> limit_fractions(std::span<const Limits> limits, const Trajectory& trajectory,
                                    int order, BudgetMeter& budget = unlimited());

}  // namespace beeline::internal
