#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

/// Whether the arm has six revolute joints, each driven by its own coordinate, and the solver is
/// reliable for it. Takes milliseconds for such an arm, once.
bool applies_raghavan_roth(SolverState& state) {
  if (!has_revolute_joints(state, 6) || state.options.lock) return false;
  state.eliminations.emplace(state.arm, OnlyKey{}, state.similar);
  return (*state.eliminations)->reliable;
}

std::string raghavan_roth_name(const SolverState&) { return "general six joints"; }

void solve_raghavan_roth(SolverState& state, const Request& request, StageResult& found) {
  Eigen::Matrix<double, 6, RaghavanRothSolver::max_solutions> q;
  const Kept<RaghavanRothSolver> solver(state.arm, OnlyKey{}, **state.eliminations);
  const RaghavanRothSolver::Result all = solver->solve(request.goal, q);
  for (int i = 0; i < all.count; ++i) {
    found.solutions->candidate = q.col(i);
    add_candidate(request, found.solutions->candidate, found);
  }
  found.unconstrained.doubtful |= !all.complete;
}

}  // namespace

const AnalyticFamily raghavan_roth_family{.applies = applies_raghavan_roth,
                                          .name = raghavan_roth_name,
                                          .solve = solve_raghavan_roth,
                                          .slower_than_search = true};

}  // namespace beeline::internal
