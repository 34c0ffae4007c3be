#include <algorithm>

#include <beeline/inverse/analytic/planar_solver.h>
#include <beeline/inverse/internal/methods.h>
#include <beeline/inverse/internal/reason.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline::internal {
namespace {

/// A claim of a closed form, limits ignored: mended, checked, and counted.
class Claims {
 public:
  Claims(const Request& request, InverseResult& result) : request_(request), result_(result) {}

  void add(Configuration q, bool continuum) {
    if (!q.allFinite()) {
      unconstrained.doubtful = true;
      return;
    }
    unconstrained.continuum = unconstrained.continuum || continuum;
    const double error = error_at(request_, q);
    constexpr double hopeless = 1e-3;  // of the size: an added joint is not where it must be
    const double size = std::max(1.0, unit_of_length(request_.arm));
    if (!(error <= hopeless * size)) return;
    if (error > request_.tolerance / 100) {
      const NumericalResult mended =
          levenberg_marquardt(request_.arm, request_.goal, request_.task, no_bounds(request_.arm),
                              q, {.tolerance = request_.tolerance});
      constexpr double far = 1e-2;  // radians: another solution
      if (!mended.converged || (mended.q - q).norm() > far) {
        unconstrained.doubtful = true;
        return;
      }
      q = mended.q;
    }
    const Configuration turned =
        nearest_representative(request_.arm, q, request_.seed, request_.bounds);
    const double outside = excess(request_.bounds, turned);
    if (!unconstrained.least || outside < least_) unconstrained.least = turned, least_ = outside;
    confirm(request_, q, result_);
  }

  UnconstrainedResult unconstrained;

 private:
  const Request& request_;
  InverseResult& result_;
  double least_ = 0;
};

void add_branches(const PieperSolver& form, const PieperBranches& found, double value, int dof,
                  Claims& claims) {
  for (int lane = 0; lane < 8; ++lane) {
    if ((found.found >> lane & 1) == 0) continue;
    Configuration q(dof);
    form.configuration(found, lane, value, q);
    claims.add(q, !form.has_virtual_joints() && (found.continuum >> lane & 1) != 0);
  }
}

void solve_locked(InverseMethods& methods, const Request& request, Claims& claims) {
  const PieperSolver& form = *methods.closed;
  PieperRequest six =
      form.request(request.seed, request.bounds.lower, request.bounds.upper, request.tolerance);
  const LockedRange range = locked_range(request.arm, request.bounds, request.seed, form);
  const int dof = request.arm.dof();
  claims.unconstrained.complete = false;
  const int grid = request.options.grid;
  if (request.options.all) {
    for (const double value : grid_values(range, grid)) {
      PieperBranches found;
      form.branches(request.goal, value, six, found);
      add_branches(form, found, value, dof, claims);
    }
    return;
  }
  LeastOutside outside;
  const LockedBranch branch =
      request.options.redundancy == Redundancy::any
          ? first_within(form, request.goal, range, grid, six, outside)
          : best_within(form, request.goal, range, grid, request.options.redundancy, six);
  Configuration q(dof);
  if (branch.lane >= 0) {
    form.configuration(branch.found, branch.lane, branch.value, q);
    return claims.add(q, (branch.found.continuum >> branch.lane & 1) != 0);
  }
  for (int i = 0; i < outside.count; ++i) {
    claims.add(Eigen::Map<const Configuration>(outside.q[i], dof), false);
  }
  if (outside.count > 0 && solve_from(methods, request.goal, outside, request.tolerance, q)) {
    claims.add(q, false);
  }
}

void solve_planar(const Request& request, Claims& claims) {
  for (const PlanarSolution& candidate : nearest_planar_solutions(
           request.arm, request.goal, request.task, request.seed, request.tolerance)) {
    claims.add(candidate.q, candidate.continuum);
  }
}

}  // namespace

UnconstrainedResult solve_general(const RaghavanRothSolver& general, const Request& request,
                                  InverseResult& result) {
  Claims claims(request, result);
  Eigen::Matrix<double, 6, RaghavanRothSolver::max_solutions> q;
  const RaghavanRothSolver::Result found = general.solve(request.goal, q);
  for (int i = 0; i < found.count; ++i) claims.add(q.col(i), false);
  claims.unconstrained.complete = found.complete && !claims.unconstrained.doubtful;
  claims.unconstrained.doubtful = !claims.unconstrained.complete;
  return claims.unconstrained;
}

UnconstrainedResult solve_closed(InverseMethods& methods, const Request& request,
                                 InverseResult& result) {
  Claims claims(request, result);
  claims.unconstrained.complete = true;
  if (methods.planar) {
    solve_planar(request, claims);
  } else if (methods.closed && methods.closed->locked()) {
    solve_locked(methods, request, claims);
  } else if (methods.closed) {
    PieperRequest six = methods.closed->request(request.seed, request.bounds.lower,
                                                request.bounds.upper, request.tolerance);
    PieperBranches found;
    methods.closed->branches(request.goal, 0, six, found);
    add_branches(*methods.closed, found, 0, request.arm.dof(), claims);
    // Where an added joint may share a turn with the arm's, only one of infinitely many was seen.
    claims.unconstrained.complete = !methods.closed->has_virtual_joints() || found.continuum == 0;
    claims.unconstrained.doubtful |=
        !methods.closed_is_sure || nearly_found(*methods.closed, found);
  } else if (methods.general) {
    return solve_general(*methods.general, request, result);
  }
  claims.unconstrained.complete = claims.unconstrained.complete && !claims.unconstrained.doubtful;
  result.singular = claims.unconstrained.continuum && !result.solutions.empty();
  return claims.unconstrained;
}

}  // namespace beeline::internal
