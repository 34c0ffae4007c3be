#include <algorithm>
#include <vector>

#include <beeline/inverse/internal/analytic_families.h>
#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/internal/stages.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline::internal {
namespace {

struct Stage {
  /// Whether the stage can add solutions or evidence to `found`.
  bool (*applies)(const SolverState& state, const Request& request, const StageResult& found);
  void (*run)(SolverState& state, const Request& request, StageResult& found);
};

bool always(const SolverState&, const Request&, const StageResult&) { return true; }

bool applies_to_one(const SolverState&, const Request& request, const StageResult&) {
  return !request.options.all;
}

bool applies_to_all(const SolverState&, const Request& request, const StageResult&) {
  return request.options.all;
}

/// Adds the seed if it is a solution, because no other one is nearer. Next to a singularity the
/// closed form may lose it to rounding.
void add_seed(SolverState&, const Request& request, StageResult& found) {
  if (!within(request.bounds, request.seed)) return;
  if (error_at(request, request.seed) > request.tolerance) return;
  std::vector<Configuration>& solutions = found.result.solutions;
  const auto same = std::find_if(solutions.begin(), solutions.end(), [&](const Configuration& q) {
    return same_posture(request.arm, q, request.seed);
  });
  if (same != solutions.end()) {
    *same = request.seed;
    return;
  }
  solutions.push_back(request.seed);
  UnconstrainedResult& evidence = found.unconstrained;
  if (!evidence.continuum) evidence.complete = evidence.branches_complete = false;
}

/// Searches for a proof that there is no solution.
void check_invariants(SolverState&, const Request& request, StageResult& found) {
  UnconstrainedResult& evidence = found.unconstrained;
  evidence.violation =
      invariant_violation(request.arm, request.goal, request.task, request.tolerance);
  evidence.complete = evidence.branches_complete = evidence.violation.has_value();
}

bool applies_analytic(const SolverState& state, const Request&, const StageResult& found) {
  return !found.unconstrained.violation && state.family != nullptr;
}

/// Whether a search may find solutions that are missing.
bool applies_numerical(const SolverState& state, const Request& request, const StageResult& found) {
  const UnconstrainedResult& evidence = found.unconstrained;
  const bool none = found.result.solutions.empty();
  const bool missing = none || (evidence.doubtful && request.options.all);
  // All solutions were examined, except that another member of a continuum may be within limits.
  const bool proved =
      evidence.range_examined || (evidence.complete && !(evidence.continuum && none));
  return missing && !proved && state.options.method != InverseMethod::closed_form &&
         !out_of_reach(state.defaults->ball, request.goal, request.task, request.tolerance);
}

void run_family(SolverState& state, const Request& request, StageResult& found) {
  solve_analytic(*state.family, state, request, found);
}

/// Whether the search found nothing, which proves nothing, and a family remains.
bool applies_fallback(const SolverState& state, const Request& request, const StageResult& found) {
  return found.result.solutions.empty() && state.fallback &&
         applies_numerical(state, request, found);
}

void run_fallback(SolverState& state, const Request& request, StageResult& found) {
  if (state.fallback->applies(state)) solve_analytic(*state.fallback, state, request, found);
}

/// New stages are added as rows here.
constexpr Stage stages[] = {
    {applies_to_one, add_seed},       {always, check_invariants},
    {applies_analytic, run_family},   {applies_numerical, solve_numerical},
    {applies_fallback, run_fallback}, {applies_to_all, add_seed},
};

}  // namespace

StageResult run_stages(SolverState& state, const Request& request) {
  StageResult found;
  found.result.method = method_name(state);
  for (const Stage& stage : stages) {
    if (stage.applies(state, request, found)) stage.run(state, request, found);
  }
  return found;
}

}  // namespace beeline::internal
