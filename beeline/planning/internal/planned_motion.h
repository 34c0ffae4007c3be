#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/motion_request.h>

namespace beeline::internal {

inline constexpr double planning_share = 0.5;  ///< of the progress of a motion

/// Max work of one nearby_path(), in units of Budget: it bounds the time of a negative answer.
inline constexpr std::int64_t max_nearby_path_work = 100'000;

/// Plans, times and proves a motion, or returns the reason why there is none. Finds the quickest
/// motion; keep_duration() slows it down. If the best branch is not proved, and neither a start nor
/// a rate is given, tries other complete branches.
PathMotion planned_motion(const MotionRequest& request, BudgetMeter& budget);

/// Slows a planned motion down to the request's duration, and proves it again.
void keep_duration(const MotionRequest& request, BudgetMeter& budget, PathMotion& motion);

/// planned_motion(), slowed down to the request's duration if it has one.
PathMotion planned_motion_in_time(const MotionRequest& request, BudgetMeter& budget);

}  // namespace beeline::internal
