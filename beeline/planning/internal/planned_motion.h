#pragma once

#include <optional>

#include <beeline/internal/budget_meter.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/move_along.h>

namespace beeline::internal {

inline constexpr double planning_share = 0.5;  ///< of the progress of a motion

Deviation part_of_tolerance(const PathMotionOptions& options, double fraction);

/// Plans, times and proves a motion, or returns the reason why there is none. Ignores
/// options.duration and options.suggest. Where the best branch is not proved, and neither a start
/// nor a rate is given, tries other complete ones.
PathMotion planned_motion(const Arm& arm, const std::optional<Configuration>& start,
                          const Route& route, const BranchOptions& planning,
                          const PathMotionOptions& options, BudgetMeter& budget);

/// Slows a planned motion down to options.duration, and proves it again.
void keep_duration(const Arm& arm, const Route& route, const Task& task,
                   const PathMotionOptions& options, BudgetMeter& budget, PathMotion& motion);

}  // namespace beeline::internal
