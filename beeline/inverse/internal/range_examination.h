#pragma once

#include <beeline/inverse/internal/redundant_joint.h>

namespace beeline::internal {

/// The result of examine_range().
struct ExaminedRange {
  LockedBranch branch;      ///< a branch within limits, or lane -1
  bool conclusive = false;  ///< without such a branch: whether every branch is outside the limits
                            ///< throughout the range
};

inline constexpr int max_range_intervals = 64;

/// Follows every branch over the whole range of the redundant joint: evaluates its excess over the
/// limits on a grid of `intervals` and refines each local minimum that may reach zero by
/// golden-section search. The result is inconclusive if rounding may hide a solution or if a branch
/// comes near the limits. Does not allocate.
ExaminedRange examine_range(LockedRequest& locked, LeastOutside& outside,
                            int intervals = max_range_intervals);

}  // namespace beeline::internal
