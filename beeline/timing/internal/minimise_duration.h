#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/duration_problem.h>

namespace beeline::internal {

/// Minimises the duration over the spline coefficients of the squared path speed, to a relative gap
/// of 1e-3, starting from coefficients that satisfy all limits strictly. Other coefficients are not
/// changed. A primal-dual interior-point method (Boyd and Vandenberghe, *Convex Optimization*,
/// section 11.7; Nocedal and Wright, *Numerical Optimization*, section 19.3). The jerk limits are
/// not convex, so the result is a local optimum. If the budget ends the iteration, the coefficients
/// of the last step remain; they satisfy the limits.
void minimise_duration(SquaredRateSpline& spline, const DurationProblem& problem,
                       BudgetMeter& budget = unlimited());

}  // namespace beeline::internal
