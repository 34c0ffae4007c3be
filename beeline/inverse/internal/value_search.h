#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// How a search for one value of the redundant joint ended.
enum class ValueSearchEnd {
  near_seed,       ///< the search from the seed found a solution
  first_values,    ///< a branch at one of the values tried first is within the limits
  examined_range,  ///< a branch found by following all branches is within the limits
  from_outside,    ///< a search from a branch outside the limits found a solution within them
  failed,
};

/// The search for one value of the redundant joint with a branch within the limits.
struct ValueSearch {
  ValueSearchEnd end = ValueSearchEnd::failed;
  LockedBranch branch;      ///< the branch, for `first_values` and `examined_range`
  LeastOutside outside;     ///< least outside among the values tried first
  LeastOutside in_range;    ///< least outside among all branches, if they were followed
  bool conclusive = false;  ///< whether every branch was followed and is outside the limits
};

/// Searches in steps, each only if the ones before it fail: the seed's value; from the seed, and by
/// `tries` further values; from the branches that exceed the limits least; by following all
/// branches. A search writes its solution to `q`. With the option closed_form only values are tried
/// and the branches outside them.
ValueSearch search_value(SolverState& state, const Pose& goal, const ConfigurationRef& seed,
                         const LockedRange& range, int tries, PieperRequest& loop,
                         BudgetMeter& budget, Eigen::Ref<Eigen::MatrixXd> q);

}  // namespace beeline::internal
