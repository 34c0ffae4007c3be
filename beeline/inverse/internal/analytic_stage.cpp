#include <algorithm>

#include <beeline/inverse/analytic/planar_solver.h>
#include <beeline/inverse/internal/analytic_stage.h>
#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {
namespace {

/// Candidate solutions of a closed form, limits ignored. Each is corrected and checked by forward
/// kinematics, and counts as evidence.
class CandidateSolutions {
 public:
  CandidateSolutions(const Request& request, StageResult& found)
      : request_(request), found_(found) {}

  UnconstrainedResult& evidence() { return found_.unconstrained; }

  void add(Configuration q, bool continuum) {
    if (!q.allFinite()) {
      evidence().doubtful = true;
      return;
    }
    evidence().continuum = evidence().continuum || continuum;
    const double error = error_at(request_, q);
    // Relative to the arm's size. A larger error is not rounding: a virtual joint is not at zero.
    constexpr double not_a_solution = 1e-3;
    const double size = std::max(1.0, unit_of_length(request_.arm));
    if (!(error <= not_a_solution * size)) return;
    if (error > request_.tolerance / 100) {
      const NumericalResult corrected =
          levenberg_marquardt(request_.arm, request_.goal, request_.task, no_bounds(request_.arm),
                              q, {.tolerance = request_.tolerance});
      constexpr double another = 1e-2;  // radians; a larger correction leads to another branch
      if (!corrected.converged || (corrected.q - q).norm() > another) {
        evidence().doubtful = true;
        return;
      }
      q = corrected.q;
    }
    evidence().consider(request_, q);
    add_solution(request_, q, found_.result);
  }

 private:
  const Request& request_;
  StageResult& found_;
};

void add_branches(const PieperSolver& form, const PieperBranches& found, double value, int dof,
                  CandidateSolutions& candidates) {
  for (int lane = 0; lane < 8; ++lane) {
    if ((found.found >> lane & 1) == 0) continue;
    Configuration q(dof);
    form.configuration(found, lane, value, q);
    candidates.add(q, !form.has_virtual_joints() && (found.continuum >> lane & 1) != 0);
  }
}

void solve_locked(SolverState& state, const Request& request, CandidateSolutions& candidates) {
  const PieperSolver& form = *state.pieper;
  PieperRequest loop =
      form.request(request.seed, request.bounds.lower, request.bounds.upper, request.tolerance);
  const LockedRange range = locked_range(request.arm, request.bounds, request.seed, form);
  const int dof = request.arm.dof();
  candidates.evidence().complete = false;
  const int grid = request.options.grid;
  if (request.options.all) {
    for (const double value : grid_values(range, grid)) {
      PieperBranches found;
      form.branches(request.goal, value, loop, found);
      add_branches(form, found, value, dof, candidates);
    }
    return;
  }
  LeastOutside outside;
  const LockedBranch branch =
      request.options.redundancy == Redundancy::any
          ? first_within(form, request.goal, range, grid, loop, outside)
          : best_within(form, request.goal, range, grid, request.options.redundancy, loop);
  Configuration q(dof);
  if (branch.lane >= 0) {
    form.configuration(branch.found, branch.lane, branch.value, q);
    return candidates.add(q, (branch.found.continuum >> branch.lane & 1) != 0);
  }
  for (int i = 0; i < outside.count; ++i) {
    candidates.add(Eigen::Map<const Configuration>(outside.q[i], dof), false);
  }
  if (outside.count > 0 && solve_from_outside(state, request.goal, outside, request.tolerance, q)) {
    candidates.add(q, false);
  }
}

void solve_planar(const Request& request, CandidateSolutions& candidates) {
  for (const PlanarSolution& candidate : nearest_planar_solutions(
           request.arm, request.goal, request.task, request.seed, request.tolerance)) {
    candidates.add(candidate.q, candidate.continuum);
  }
}

void solve_branches(SolverState& state, const Request& request, CandidateSolutions& candidates) {
  const PieperSolver& form = *state.pieper;
  PieperRequest loop =
      form.request(request.seed, request.bounds.lower, request.bounds.upper, request.tolerance);
  PieperBranches found;
  form.branches(request.goal, 0, loop, found);
  add_branches(form, found, 0, request.arm.dof(), candidates);
  // The axis of a virtual joint may coincide with that of an arm's joint. Then only one of
  // infinitely many solutions was examined.
  candidates.evidence().complete = !form.has_virtual_joints() || found.continuum == 0;
  candidates.evidence().doubtful |= !state.pieper_verified || nearly_found(form, found);
}

}  // namespace

void solve_raghavan_roth(const RaghavanRothSolver& general, const Request& request,
                         StageResult& found) {
  found.unconstrained = {};
  CandidateSolutions candidates(request, found);
  Eigen::Matrix<double, 6, RaghavanRothSolver::max_solutions> q;
  const RaghavanRothSolver::Result all = general.solve(request.goal, q);
  for (int i = 0; i < all.count; ++i) candidates.add(q.col(i), false);
  candidates.evidence().complete = all.complete && !candidates.evidence().doubtful;
  candidates.evidence().doubtful = !candidates.evidence().complete;
}

bool has_analytic_stage(const SolverState& state) {
  return state.planar || state.pieper || state.raghavan_roth;
}

void solve_analytic(SolverState& state, const Request& request, StageResult& found) {
  if (!state.planar && !state.pieper)
    return solve_raghavan_roth(*state.raghavan_roth, request, found);
  CandidateSolutions candidates(request, found);
  UnconstrainedResult& evidence = candidates.evidence();
  evidence.complete = true;
  if (state.planar) {
    solve_planar(request, candidates);
  } else if (state.pieper->locked()) {
    solve_locked(state, request, candidates);
  } else {
    solve_branches(state, request, candidates);
  }
  evidence.complete = evidence.complete && !evidence.doubtful;
  found.result.singular = evidence.continuum && !found.result.solutions.empty();
}

}  // namespace beeline::internal
