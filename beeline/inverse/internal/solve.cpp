#include <beeline/inverse/internal/diagnosis.h>
#include <beeline/inverse/internal/joint_lock.h>
#include <beeline/inverse/internal/redundancy.h>
#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/internal/solve.h>
#include <beeline/inverse/internal/stages.h>

namespace beeline::internal {
namespace {

/// Solves for the arm with the locked coordinate fixed. Its solver is kept while the value stays
/// the same.
InverseResult solve_with_lock(SolverState& state, const Pose& world_T_tool,
                              const Configuration& seed, Diagnosis diagnosis) {
  check_configuration(state.arm, seed);
  check_lock(state, seed);
  const int k = *state.options.lock;
  const double value = seed[k];
  if (state.locked.empty() || state.locked_value != value) {
    InverseOptions options = state.options;
    options.lock.reset();
    options.seed.reset();
    options.task = state.task;
    state.locked = {make_solver_state(with_locked(state.arm, k, value), options)};
    state.locked.front().removed_coordinate = k;
    state.locked_value = value;
  }
  InverseResult result = solve(state.locked.front(), world_T_tool, without(seed, k), diagnosis);
  for (Configuration& q : result.solutions) q = with(q, k, value);
  if (result.nearest) {
    result.nearest->q = with(result.nearest->q, k, value);
    if (result.nearest->blocking >= k) ++result.nearest->blocking;
  }
  return result;
}

}  // namespace

InverseResult solve(SolverState& state, const Pose& world_T_tool, const Configuration& seed,
                    Diagnosis diagnosis) {
  if (state.options.lock) return solve_with_lock(state, world_T_tool, seed, diagnosis);
  check_configuration(state.arm, seed);
  Configuration wrapped = seed;
  wrap_unlimited_angles(state.arm, state.bounds, farthest_seed, wrapped);
  const Request request =
      make_request(state.arm, state.options, state.task, state.bounds, world_T_tool, wrapped);
  auto [result, unconstrained] = run_stages(state, request);
  if (result.solutions.empty() && diagnosis == Diagnosis::wanted) {
    diagnose(state, request, unconstrained, result);
  }
  if (result.solutions.empty()) return result;
  const bool redundant = request.arm.dof() > request.task.size() && !request.options.all;
  if (redundant && request.options.redundancy != Redundancy::any) {
    optimise_redundancy(request, result);
  }
  result.complete = request.options.all && unconstrained.complete && !result.singular;
  finish(request, result);
  if (result.singular) {
    result.reason = "singular: arm " + request.arm.name() +
                    " can move with the tool at rest, so there are infinitely many solutions; " +
                    "in those given the joints concerned are nearest to the seed";
  }
  return result;
}

}  // namespace beeline::internal
