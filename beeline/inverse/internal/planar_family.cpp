#include <beeline/inverse/analytic/planar_solver.h>
#include <beeline/inverse/internal/analytic_family.h>

namespace beeline::internal {
namespace {

bool applies_planar(SolverState& state) {
  return !state.options.lock && has_planar_closed_form(state.arm, state.task);
}

std::string planar_name(const SolverState&) { return "planar"; }

void solve_planar(SolverState&, const Request& request, StageResult& found) {
  for (PlanarSolution& candidate : nearest_planar_solutions(request.arm, request.goal, request.task,
                                                            request.seed, request.tolerance)) {
    add_candidate(request, candidate.q, found, {.continuum = candidate.continuum});
    if (!candidate.continuum || !any_finite(request.bounds)) continue;
    // Other solutions of the continuum may be within the limits, or apart from this one.
    found.unconstrained.branches_complete = false;
  }
}

}  // namespace

const AnalyticFamily planar_family{applies_planar, planar_name, solve_planar};

}  // namespace beeline::internal
