#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// A proved bound on the speed of the tool's origin, metres per second, at all times of the motion
/// that the columns mean; they are in the arm's order. Between two samples the velocity is compared
/// with its cubic Hermite polynomial, whose Bernstein coefficients bound it: the difference is at
/// most 1/384 of the fourth derivative, which tool_taylor_bound() bounds. Intervals are halved
/// until the difference is below a thousandth. 0 for one sample. If the budget ends the
/// computation, the result is not a bound.
double tool_speed_bound(const Arm& arm, const Trajectory& trajectory,
                        BudgetMeter& budget = unlimited());

/// The same between each sample and the next; known[k] if the bound does not exceed it.
std::vector<double> tool_speed_bounds(const Arm& arm, const Trajectory& trajectory,
                                      const std::vector<double>& known);

}  // namespace beeline::internal
