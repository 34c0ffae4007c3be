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
                              const Configuration& seed, Diagnosis diagnosis, BudgetMeter& budget) {
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
  InverseResult result =
      solve(state.locked.front(), world_T_tool, without(seed, k), diagnosis, budget);
  for (Configuration& q : result.solutions) q = with(q, k, value);
  if (result.nearest) {
    result.nearest->q = with(result.nearest->q, k, value);
    if (result.nearest->blocking >= k) ++result.nearest->blocking;
  }
  return result;
}

/// The status and reason of solutions that the budget ended the search for; not of the only one
/// that is requested.
void set_ended(const Request& request, bool optimised, InverseResult& result) {
  const Ending ending = request.budget.ending();
  if (ending == Ending::complete || !(request.options.all || optimised)) return;
  result.status = status_of<InverseStatus>(ending);
  result.complete = false;
  result.reason = ended_by(ending) +
                  (request.options.all ? " after " + std::to_string(result.solutions.size()) +
                                             " solution(s); others may exist"
                                       : " before the best solution was known; the one given is "
                                         "the best so far") +
                  how_to_continue(ending);
}

}  // namespace

InverseResult solve(SolverState& state, const Pose& world_T_tool, const Configuration& seed,
                    Diagnosis diagnosis, BudgetMeter& budget) {
  if (state.options.lock) return solve_with_lock(state, world_T_tool, seed, diagnosis, budget);
  check_configuration(state.arm, seed);
  Configuration wrapped = seed;
  wrap_unlimited_angles(state.arm, state.bounds, farthest_seed, wrapped);
  const Request request = make_request(state.arm, state.options, state.task, state.bounds,
                                       world_T_tool, wrapped, budget);
  state.search.iterations = 0;
  auto [result, unconstrained] = run_stages(state, request);
  if (result.solutions.empty() && diagnosis == Diagnosis::wanted) {
    diagnose(state, request, unconstrained, result);
  }
  if (result.solutions.empty()) return result;
  const bool redundant = request.arm.dof() > request.task.size() && !request.options.all;
  const bool optimised = redundant && request.options.redundancy != Redundancy::any;
  if (optimised) optimise_redundancy(request, result);
  result.complete = request.options.all && unconstrained.complete && !result.singular;
  finish(request, result);
  if (result.singular) {
    result.reason = "singular: arm " + request.arm.name() +
                    " can move with the tool at rest, so there are infinitely many solutions; " +
                    "in those given the joints concerned are nearest to the seed";
  }
  set_ended(request, optimised, result);
  return result;
}

}  // namespace beeline::internal
