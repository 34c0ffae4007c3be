#pragma once

#include <vector>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/inverse/internal/request.h>

namespace beeline::internal {

/// The values of a PieperSolver's locked coordinate that come into question: its limits, or one
/// turn (for a slide, the arm's size to both sides) about the seed where it has none.
struct LockedRange {
  double lower = 0, upper = 0;
  double seed = 0;
  bool limited = false;  ///< whether both ends are limits
};
LockedRange locked_range(const Arm& arm, const Bounds& bounds, const ConfigurationRef& seed,
                         const PieperSolver& form);

/// One branch, with the locked coordinate's value.
struct LockedBranch {
  double value = 0;
  int lane = -1;  ///< of `found`; -1: none
  PieperBranches found;
};

/// The lane nearest to the seed among those within limits whose loops are closed; -1: none.
int nearest_lane(const PieperRequest& six, const PieperBranches& found);

/// Whether a lane without a solution comes so near to one that rounding may have hidden it.
bool nearly_found(const PieperSolver& form, const PieperBranches& found);

/// The branches that exceed limits least, of those that were met.
struct LeastOutside {
  int count = 0;
  double excess[8] = {};  ///< ascending
  double q[8][7] = {};    ///< by coordinate
};

/// Tries values, first the seed's, then ever finer steps of the range, nearest to the seed first in
/// each round, until there is a branch within limits or `tries` are used up. Does not allocate.
LockedBranch first_within(const PieperSolver& form, const Pose& goal, const LockedRange& range,
                          int tries, PieperRequest& six, LeastOutside& outside);

/// The branch within limits that is best: nearest to the seed, or farthest from the limits. The
/// best of a grid, made better between its neighbours by golden sections.
LockedBranch best_within(const PieperSolver& form, const Pose& goal, const LockedRange& range,
                         int grid, Redundancy redundancy, PieperRequest& six);

/// The values of a grid over the range, its ends included.
std::vector<double> grid_values(const LockedRange& range, int grid);

}  // namespace beeline::internal
