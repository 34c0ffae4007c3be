#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/solve_fast_path.h>

namespace beeline::internal {

std::optional<int> solve_fast_path(SolverState& state, const Pose& goal,
                                   const ConfigurationRef& seed, BudgetMeter& budget,
                                   const Eigen::Ref<Eigen::MatrixXd>& solutions) {
  const InverseOptions& options = state.options;
  if (seed.cwiseAbs().maxCoeff() > farthest_seed) return std::nullopt;
  if (state.family) {
    if (!state.family->solve_fast) return std::nullopt;
    return state.family->solve_fast(state, goal, seed, budget, solutions);
  }
  const bool any_one = !options.all && options.redundancy == Redundancy::any;
  if (!any_one || options.lock || out_of_reach(state.arm, goal, state.task, options.tolerance) ||
      !search_fast_path(state, goal, seed, budget, solutions)) {
    return std::nullopt;
  }
  return 1;
}

}  // namespace beeline::internal
