#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// Minimum time under velocity, acceleration and jerk limits, from rest to rest with zero
/// acceleration at both ends; q'' must be continuous. The variable is a time scaling t(tau) of the
/// motion q(tau) that follows the path by the rest-to-rest quintic. With the squared rate
/// b(tau) = (dtau/dt)^2, a quadratic spline with derivatives b' and b'',
///     minimise    T = integral of b^(-1/2) over tau
///     subject to  b <= (velocity_i / q_i')^2,  limits.speed likewise,
///                 |q_i'' b + q_i' b' / 2| <= acceleration_i,
///                 |b^(1/2) (q_i''' b + 3/2 q_i'' b' + q_i' b'' / 2)| <= jerk_i,
/// by an interior-point method (minimise_duration.h). The constraints are imposed at three times of
/// each step of the spline and checked at more; if they are violated by more than 2 %, the spline
/// gets more knots; the remaining violation is removed by slowing the whole motion down. If the
/// result is much slower than fastest(), as with a tight corner that nearly requires a stop, a stop
/// there is tried as well. The result is a local optimum, to about 1e-3 without a tight corner, and
/// never slower than the quintic. The limits hold at the checked times. The quintic between two
/// points of the result (see TimeScaling::smooth) exceeds the jerk limit where the jerk of the
/// optimum jumps between them: by less than 10 % on 900 random paths. retime() measures its samples
/// and slows down for that. If the budget ends the search, returns the best time scaling so far,
/// which keeps the limits, or none, with the reason, if there is none yet. Throws Error for
/// arguments that check_path() or check_limits() refuses, and without any jerk limit.
TimeScaling jerk_limited(const JointPath& path, const PathLimits& limits,
                         BudgetMeter& budget = unlimited());

}  // namespace beeline::internal
