#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// ds/dt at both ends of the path.
struct EndSpeeds {
  double begin = 0, end = 0;
};

/// Minimum time under velocity and acceleration limits:
///     minimise T  subject to  |q' ds/dt| <= velocity,  |q' d2s/dt2 + q'' (ds/dt)^2| <=
///     acceleration,
///                             ds/dt <= limits.speed,  given ds/dt at both ends;
/// jerk is not limited. By reachability analysis (H. Pham and Q.-C. Pham, IEEE Transactions on
/// Robotics 34(3), 2018): a backward pass computes the interval of squared speeds at each grid
/// point from which the end can be reached; a forward pass takes the largest of them. Between grid
/// points d2s/dt2 is constant, and the limits hold there too: the acceleration limits hold exactly
/// for a cubic path, otherwise to the error of a parabola through both ends and the middle of a
/// step. The time is linear in the number of grid points. A path along which nothing moves takes at
/// least 1 ms in total. Returns no time scaling, with the reason, if the speeds at the ends are too
/// high or the budget ends the computation. Throws Error for speeds at the ends that are negative
/// or not finite, and for arguments that check_path() or check_limits() refuses.
TimeScaling fastest(const JointPath& path, const PathLimits& limits, const EndSpeeds& ends = {},
                    BudgetMeter& budget = unlimited());

}  // namespace beeline::internal
