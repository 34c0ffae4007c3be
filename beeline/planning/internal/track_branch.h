#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/track_segment.h>

namespace beeline::internal {

/// Computes every branch of a non-redundant arm along the path, one for each solution of inverse
/// kinematics at its beginning; see better() for their order.
///
/// Coordinates of joints with a range above 2 pi are tracked without limits. Each then gets the
/// multiple of 2 pi for which the branch stays within the limits longest, and with the largest
/// margin. If no branch is complete, SingularWaypoints continues the branches that are singular at
/// a waypoint, including the path's beginning. Returns nothing if no branch begins there. Throws
/// Error as plan_path() does.
std::vector<Branch> track_branches(const Arm& arm, const ToolPath& path,
                                   const BranchOptions& options);

/// The same for the one branch that begins at `start`, within the limits.
Branch track_branch(const Arm& arm, const Configuration& start, const ToolPath& path,
                    const BranchOptions& options);

/// Sets the status and reason of a branch that is incomplete and has no reason yet.
void explain(const Arm& arm, const ToolPath& path, const BranchOptions& options, Branch& branch);

/// Sets limit_margin, inverse_condition and spare_clearance from the branch's samples, or to 0 if
/// the budget has ended.
void measure(const Arm& arm, const BranchOptions& options, BudgetMeter& budget, Branch& branch);

/// The order of branches: the one that reaches farther; of two that reach as far the one that is
/// not blocked; then the one with the larger smallest margin.
bool better(const Branch& a, const Branch& b);

}  // namespace beeline::internal
