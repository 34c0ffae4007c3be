#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// Time scalings from rest to rest whose form does not depend on the path: s(t) has at most two
/// shape parameters, and its duration is the smallest that the limits allow at every path
/// parameter.
enum class ScalarForm {
  trapezoidal,  ///< ds/dt: constant acceleration, cruise, constant deceleration; jerk is not
                ///< limited
  quintic,      ///< rest_to_rest(t / T)
  s_curve,      ///< d2s/dt2: a trapezoid, cruise, the same mirrored (s_curve_state.h)
};

/// Minimises the duration over the shape parameters of the form subject to the limits of velocity,
/// acceleration and, except for the trapezoid, jerk. One or two scans with golden sections, which
/// may end in a local optimum on a path with many curves. Returns no time scaling, with the reason,
/// if the budget ends the computation. Throws Error for arguments that check_path() or
/// check_limits() refuses.
TimeScaling scalar_profile(ScalarForm form, const JointPath& path, const PathLimits& limits,
                           BudgetMeter& budget = unlimited());

}  // namespace beeline::internal
