#pragma once

#include <vector>

#include <beeline/inverse/analytic/pieper_solver.h>
#include <beeline/inverse/internal/request.h>

namespace beeline::internal {

/// The range of a coordinate that is locked, the redundant joint: its limits or, without limits,
/// one revolution (for a prismatic joint, `size` to both sides) about the seed.
struct LockedRange {
  double lower = 0, upper = 0;
  double seed = 0;
  double weight = 1;     ///< weight of the coordinate in distances
  bool limited = false;  ///< whether both ends are limits
};
LockedRange locked_range(const Arm& arm, const Bounds& bounds, const ConfigurationRef& seed,
                         int coordinate, double size);

/// A request to a closed form that has a locked coordinate.
struct LockedRequest {
  const PieperSolver& form;
  const Request& request;
  PieperRequest loop;      ///< form.request() with the seed, weights and limits that count
  LockedRange range = {};  ///< of the locked coordinate
};

/// A branch with the value of the locked coordinate.
struct LockedBranch {
  double value = 0;
  int lane = -1;  ///< lane of `found`; -1: none
  PieperBranches found;
};

/// Returns the lane nearest to the seed among the lanes within limits whose loops close; -1 if
/// there is none.
int nearest_lane(const PieperRequest& loop, const PieperBranches& found);

/// Whether a lane may have a solution that rounding hides.
bool nearly_found(const PieperSolver& form, const PieperBranches& found);

/// Whether a solution may be nearer to the seed than the nearest_lane(): next to a singularity,
/// rounding moves solutions, out of the limits too, or hides them.
bool may_be_nearer(const LockedRequest& locked, const PieperBranches& found);

/// The branches that exceed the limits least among those examined.
struct LeastOutside {
  static constexpr int capacity = 8;
  int count = 0;
  double excess[capacity] = {};  ///< ascending
  double q[capacity][7] = {};    ///< coordinates of each branch

  /// Inserts a lane of the branch in the order of its excess, if its excess is among the least.
  void insert(const PieperSolver& form, const LockedBranch& branch, int lane);
};

/// Computes the branches for a value of the redundant joint; the lane is the nearest_lane().
void evaluate(LockedRequest& locked, double value, LockedBranch& branch);

/// Returns the branch within limits that is nearest to the seed, for a value of the redundant
/// joint. Adds the others to `outside` if there is none.
LockedBranch branch_at(LockedRequest& locked, double value, LeastOutside& outside);

/// Tries values of the redundant joint other than the seed's until a branch is within limits, up to
/// `tries` values: at multiples of a quarter of the range from the seed's, then of an eighth, and
/// so on, nearest to the seed first. Does not allocate.
LockedBranch first_within(LockedRequest& locked, int tries, LeastOutside& outside);

/// Returns the branch within limits that is nearest to the seed among few values of the redundant
/// joint, which are denser if the tool is near the pose at the seed, if its squared distance is
/// below `least`. Does not allocate.
LockedBranch nearest_of_few(LockedRequest& locked, bool tool_is_near, double least);

/// Returns the branch within limits that is nearest to the seed, or farthest from the limits, as
/// the request asks. Refines the three best values of its grid between their neighbours by
/// golden-section search.
LockedBranch best_within(LockedRequest& locked);

/// Returns the values of a grid over the range, its ends included.
std::vector<double> grid_values(const LockedRange& range, int grid);

}  // namespace beeline::internal
