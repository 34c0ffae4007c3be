#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/motion_request.h>

namespace beeline::internal {

inline constexpr double planning_share = 0.5;  ///< of the progress of a motion

/// Plans, times and proves a motion, or returns the reason why there is none. Ignores the duration.
/// If the best branch is not proved, and neither a start nor a rate is given, tries other complete
/// branches.
PathMotion planned_motion(const MotionRequest& request, BudgetMeter& budget);

/// Slows a planned motion down to the request's duration, and proves it again.
void keep_duration(const MotionRequest& request, BudgetMeter& budget, PathMotion& motion);

}  // namespace beeline::internal
