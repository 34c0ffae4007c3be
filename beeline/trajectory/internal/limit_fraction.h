#pragma once

#include <span>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The limits of a motion of the arm, of each coordinate: see motion_limits().
std::vector<Limits> motion_limits_of(const Arm& arm);

/// The largest fraction of the limits of one kind that a trajectory uses, with its coordinate and
/// sample.
struct CoordinateFraction {
  double fraction = 0;
  int coordinate = 0;
  std::size_t sample = 0;  ///< the one before it; of a divided difference, where it jumps
  bool exact = true;       ///< see LimitFraction
};

/// Computes the largest fraction for the derivative of an order from 1 (velocity) to 3 (jerk).
/// `limits` has the limits of each column of the trajectory; infinite limits have the fraction 0.
/// If the budget ends the computation, returns the largest fraction so far.
CoordinateFraction limit_fraction(std::span<const Limits> limits, const Trajectory& trajectory,
                                  int order, BudgetMeter& budget = unlimited());

/// Computes the largest distance of a coordinate from the middle of its range, as a fraction of
/// half the range, for the motion that the columns mean; coordinates without a range are left out.
/// The coordinate is -1 if none has a range. If the budget ends the computation, returns the
/// largest fraction so far.
CoordinateFraction range_fraction(std::span<const Limits> limits, const Trajectory& trajectory,
                                  BudgetMeter& budget = unlimited());

/// Computes the largest fraction of the limits of that order between each two samples; 0 for an
/// order that the interpolation does not bound, and if the budget ends the computation.
std::vector<double> limit_fractions(std::span<const Limits> limits, const Trajectory& trajectory,
                                    int order, BudgetMeter& budget = unlimited());

}  // namespace beeline::internal
