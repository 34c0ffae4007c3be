#include <algorithm>

#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/solve_fast_path.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

std::optional<InverseResult> without_solutions(SolverState& state, const Pose& goal,
                                               const ConfigurationRef& seed,
                                               const FastSolutions& found, BudgetMeter& budget) {
  const Request request = make_request(state, goal, seed, budget);
  UnconstrainedResult evidence;
  evidence.range_examined = found.examined;
  const std::optional<InverseStatus> status =
      found.outside ? InverseStatus::outside_limits
                    : status_without_nearest(state, request, evidence);
  if (!status) return {};
  InverseResult result;
  result.method = method_name(state);
  set_unexplained(request, evidence, *status, result);
  return result;
}

}  // namespace

std::optional<FastSolutions> solve_fast_path(SolverState& state, const Pose& goal,
                                             const ConfigurationRef& seed, BudgetMeter& budget,
                                             const Eigen::Ref<Eigen::MatrixXd>& solutions) {
  const InverseOptions& options = state.options;
  if (seed.cwiseAbs().maxCoeff() > farthest_seed) return std::nullopt;
  if (state.family) {
    if (!state.family->solve_fast) return std::nullopt;
    return state.family->solve_fast(state, goal, seed, budget, solutions);
  }
  const bool any_one = !options.all && state.redundancy == Redundancy::any;
  if (!any_one || options.lock ||
      out_of_reach(state.defaults->ball, goal, state.task, options.tolerance) ||
      !search_fast_path(state, goal, seed, budget, solutions)) {
    return std::nullopt;
  }
  return FastSolutions{1};
}

std::optional<InverseResult> one_solution_fast(SolverState& state, const Pose& world_T_tool,
                                               const ConfigurationRef& seed, FailureDetail detail,
                                               BudgetMeter& budget) {
  const InverseOptions& options = state.options;
  if (options.all) return {};
  check_configuration(state.arm, seed);
  const Pose goal = checked_pose(world_T_tool);
  const auto error_at = [&](const ConfigurationRef& q) {
    const Deviation error = task_deviation(state.task, goal, forward_kinematics(state.arm, q));
    return std::max(error.position, error.orientation);
  };
  state.reset_search();
  // Next to a singularity the closed form may lose a solution to rounding. solve() adds the seed.
  const bool keeps_seed = options.redundancy != Redundancy::centred && !options.lock;
  if (keeps_seed && within(state.bounds, seed) && error_at(seed) <= options.tolerance) return {};
  Configuration q(state.arm.dof());
  const std::optional<FastSolutions> found = solve_fast_path(state, goal, seed, budget, q);
  if (found && found->count == 0 && detail == FailureDetail::status) {
    return without_solutions(state, goal, seed, *found, budget);
  }
  if (!found || found->count == 0) return {};
  const double residual = error_at(q);
  if (!(residual <= options.tolerance)) return {};
  InverseResult result;
  result.status = InverseStatus::solved;
  result.solutions.push_back(std::move(q));
  result.residual = residual;
  if (state.scratch) {
    result.iterations = state.search().iterations;
    result.restarts = state.search().restarts;
  }
  result.method = result.iterations > 0 ? "numerical" : method_name(state);
  return result;
}

}  // namespace beeline::internal
