#pragma once

#include <functional>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/planning/branch.h>

namespace beeline::internal {

/// The arguments of tracking the branches along a path.
struct BranchSearch {
  const Arm& arm;
  const ToolPath& path;
  Bounds bounds;
  const BranchOptions& options;
  BudgetMeter& budget;  ///< replaces options.budget

  /// The same search with another meter, for a part of it.
  BranchSearch with(BudgetMeter& part) const { return {arm, path, bounds, options, part}; }
};

/// Sets the segment of a reason, and its name: "line 2 of 3".
void set_segment(const ToolPath& path, std::size_t i, Reason& reason);

/// Sets the status and reason of a branch that the budget ended.
void set_ended(const ToolPath& path, Ending ending, Branch& branch);

/// Tracks the path from the end of the branch's segments, or from branch.start if it has none.
/// `departure` returns the initial guess at a fraction of the first segment that moves, or an empty
/// configuration: see TrackOptions::guide. A branch that remains incomplete gets the status
/// not_found and no reason, see explain(), or the budget's status if the budget ended it.
void track_path(const BranchSearch& search, Branch& branch,
                std::function<Configuration(double)> departure = {});

}  // namespace beeline::internal
