#pragma once

#include <beeline/timing/internal/duration_problem.h>

namespace beeline {

/// Makes the clock as fast as the problem allows, up to a thousandth or less, from coefficients
/// that keep all limits with room to spare; where they do not, nothing changes. By a primal-dual
/// interior-point method (Boyd and Vandenberghe, Convex Optimization, section 11.7; Nocedal and
/// Wright, Numerical Optimization, section 19.3).
void minimise_duration(SquaredRateSpline& clock, const DurationProblem& problem);

}  // namespace beeline
