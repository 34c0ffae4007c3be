#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/candidate_solutions.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

/// Whether the arm has six revolute joints, each driven by its own coordinate, and the solver is
/// reliable for it. Takes milliseconds for such an arm.
bool applies_raghavan_roth(SolverState& state) {
  if (!has_revolute_joints(state, 6) || state.options.lock) return false;
  const Chain& chain = chain_of(state.arm);
  if (state.similar) state.raghavan_roth.emplace(chain, *state.similar);
  if (!state.similar || !state.raghavan_roth->reliable()) state.raghavan_roth.emplace(chain);
  if (!state.raghavan_roth->reliable()) state.raghavan_roth.reset();
  return state.raghavan_roth.has_value();
}

std::string raghavan_roth_name(const SolverState&) { return "general six joints"; }

void solve_raghavan_roth(SolverState& state, const Request& request, StageResult& found) {
  CandidateSolutions candidates(request, found);
  UnconstrainedResult& evidence = candidates.evidence();
  Eigen::Matrix<double, 6, RaghavanRothSolver::max_solutions> q;
  const RaghavanRothSolver::Result all = state.raghavan_roth->solve(request.goal, q);
  for (int i = 0; i < all.count; ++i) candidates.add(q.col(i), false);
  evidence.doubtful = evidence.doubtful || !all.complete;
}

}  // namespace

const AnalyticFamily raghavan_roth_family{.applies = applies_raghavan_roth,
                                          .name = raghavan_roth_name,
                                          .solve = solve_raghavan_roth,
                                          .slower_than_search = true};

}  // namespace beeline::internal
