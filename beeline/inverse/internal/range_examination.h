#pragma once

#include <beeline/inverse/internal/redundant_joint.h>

namespace beeline::internal {

/// What examine_range() has shown.
struct ExaminedRange {
  LockedBranch branch;      ///< one within limits, or lane -1
  bool conclusive = false;  ///< else: whether every branch is outside them throughout the range
};

/// Follows every branch over the whole range of the redundant joint: evaluates its excess over the
/// limits on a grid and refines each local minimum that may reach zero by golden-section search.
/// Inconclusive where rounding may hide a solution or where a branch comes near the limits. Does
/// not allocate.
ExaminedRange examine_range(const PieperSolver& form, const Pose& goal, const LockedRange& range,
                            PieperRequest& loop, BudgetMeter& budget, LeastOutside& outside);

}  // namespace beeline::internal
