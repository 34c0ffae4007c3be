#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/range_examination.h>
#include <beeline/inverse/internal/value_search.h>

namespace beeline::internal {
namespace {

/// Writes the solution to which a search from the seed converges, if it is nearer to the seed than
/// `branch`, the one for the seed's value of the redundant joint. There may be none for that value
/// although one is near: a value next to it has the solutions that it lacks. Returns whether it is
/// written; otherwise the column is undefined.
bool solve_near_seed(SolverState& state, const Pose& goal, const ConfigurationRef& seed,
                     const LockedBranch& branch, BudgetMeter& budget,
                     Eigen::Ref<Eigen::MatrixXd> solutions) {
  constexpr double far = 0.25;  // square of a distance that is another branch, or nearly one
  const bool found = branch.lane >= 0;
  const double distance = found ? branch.found.distance[branch.lane] : Limits::none;
  if (distance < far * state.weights.maxCoeff()) return false;
  if (search_from_seed(state, goal, seed, budget, solutions.col(0)) &&
      (solutions.col(0) - seed).cwiseAbs2().dot(state.weights) < distance) {
    return true;
  }
  state.reset_search();  // the closed form solves
  return false;
}

}  // namespace

ValueSearch search_value(SolverState& state, const Pose& goal, const ConfigurationRef& seed,
                         const LockedRange& range, int tries, PieperRequest& loop,
                         BudgetMeter& budget, Eigen::Ref<Eigen::MatrixXd> q) {
  const PieperSolver& form = state.pieper_solver();
  const bool automatic = state.options.method == InverseMethod::automatic;
  const auto solved_from = [&](const LeastOutside& outside) {
    return outside.count > 0 &&
           solve_from_outside(state, goal, outside, state.options.tolerance, q.col(0));
  };
  ValueSearch search;
  const auto ended = [&](ValueSearchEnd end) {
    search.end = end;
    return search;
  };
  search.branch = branch_at(form, goal, range.seed, loop, search.outside);
  if (automatic && solve_near_seed(state, goal, seed, search.branch, budget, q)) {
    return ended(ValueSearchEnd::near_seed);
  }
  if (search.branch.lane < 0) {
    search.branch = first_within(form, goal, range, tries, loop, budget, search.outside);
  }
  if (search.branch.lane >= 0) return ended(ValueSearchEnd::first_values);
  if (solved_from(search.outside)) return ended(ValueSearchEnd::from_outside);
  if (!automatic) return search;
  const ExaminedRange examined = examine_range(form, goal, range, loop, budget, search.in_range);
  search.branch = examined.branch;
  if (search.branch.lane >= 0) return ended(ValueSearchEnd::examined_range);
  if (solved_from(search.in_range)) return ended(ValueSearchEnd::from_outside);
  search.conclusive = examined.conclusive;
  return search;
}

}  // namespace beeline::internal
