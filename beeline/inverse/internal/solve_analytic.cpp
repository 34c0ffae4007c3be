#include <algorithm>

#include <beeline/inverse/analytic/planar.h>
#include <beeline/inverse/internal/methods.h>
#include <beeline/inverse/internal/reason.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline {
namespace {

/// A claim of a closed form, limits ignored: mended, checked, and counted.
class Claims {
 public:
  Claims(const Question& ask, InverseResult& result) : ask_(ask), result_(result) {}

  void add(Configuration q, bool continuum) {
    if (!q.allFinite()) {
      beyond.doubtful = true;
      return;
    }
    beyond.continuum = beyond.continuum || continuum;
    const double error = error_at(ask_, q);
    constexpr double hopeless = 1e-3;  // of the size: an added joint is not where it must be
    const double size = std::max(1.0, unit_of_length(ask_.arm));
    if (!(error <= hopeless * size)) return;
    if (error > ask_.tolerance / 100) {
      const Descent mended = descend(ask_.arm, ask_.goal, ask_.task, no_bounds(ask_.arm), q,
                                     {.tolerance = ask_.tolerance});
      constexpr double far = 1e-2;  // radians: another solution
      if (!mended.converged || (mended.q - q).norm() > far) {
        beyond.doubtful = true;
        return;
      }
      q = mended.q;
    }
    const Configuration turned = nearest_representative(ask_.arm, q, ask_.seed, ask_.bounds);
    const double outside = excess(ask_.bounds, turned);
    if (!beyond.least || outside < least_) beyond.least = turned, least_ = outside;
    confirm(ask_, q, result_);
  }

  Beyond beyond;

 private:
  const Question& ask_;
  InverseResult& result_;
  double least_ = 0;
};

void add_branches(const ClosedForm& form, const SixBranches& found, double value, int dof,
                  Claims& claims) {
  for (int lane = 0; lane < 8; ++lane) {
    if ((found.found >> lane & 1) == 0) continue;
    Configuration q(dof);
    form.configuration(found, lane, value, q);
    claims.add(q, !form.has_added_joints() && (found.continuum >> lane & 1) != 0);
  }
}

void solve_locked(InverseMethods& methods, const Question& ask, Claims& claims) {
  const ClosedForm& form = *methods.closed;
  SixQuestion six = form.question(ask.seed, ask.bounds.lower, ask.bounds.upper, ask.tolerance);
  const LockedRange range = locked_range(ask.arm, ask.bounds, ask.seed, form);
  const int dof = ask.arm.dof();
  claims.beyond.complete = false;
  const int grid = ask.options.grid;
  if (ask.options.all) {
    for (const double value : grid_values(range, grid)) {
      SixBranches found;
      form.branches(ask.goal, value, six, found);
      add_branches(form, found, value, dof, claims);
    }
    return;
  }
  LeastOutside outside;
  const LockedBranch branch =
      ask.options.redundancy == Redundancy::any
          ? first_within(form, ask.goal, range, grid, six, outside)
          : best_within(form, ask.goal, range, grid, ask.options.redundancy, six);
  Configuration q(dof);
  if (branch.lane >= 0) {
    form.configuration(branch.found, branch.lane, branch.value, q);
    return claims.add(q, (branch.found.continuum >> branch.lane & 1) != 0);
  }
  for (int i = 0; i < outside.count; ++i) {
    claims.add(Eigen::Map<const Configuration>(outside.q[i], dof), false);
  }
  if (outside.count > 0 && descend_from(methods, ask.goal, outside, ask.tolerance, q)) {
    claims.add(q, false);
  }
}

void solve_planar(const Question& ask, Claims& claims) {
  for (const PlanarSolution& candidate :
       nearest_planar_solutions(ask.arm, ask.goal, ask.task, ask.seed, ask.tolerance)) {
    claims.add(candidate.q, candidate.continuum);
  }
}

}  // namespace

Beyond solve_general(const GeneralSix& general, const Question& ask, InverseResult& result) {
  Claims claims(ask, result);
  Eigen::Matrix<double, 6, GeneralSix::max_solutions> q;
  const GeneralSix::Found found = general.solve(ask.goal, q);
  for (int i = 0; i < found.count; ++i) claims.add(q.col(i), false);
  claims.beyond.complete = found.complete && !claims.beyond.doubtful;
  claims.beyond.doubtful = !claims.beyond.complete;
  return claims.beyond;
}

Beyond solve_closed(InverseMethods& methods, const Question& ask, InverseResult& result) {
  Claims claims(ask, result);
  claims.beyond.complete = true;
  if (methods.planar) {
    solve_planar(ask, claims);
  } else if (methods.closed && methods.closed->locked() >= 0) {
    solve_locked(methods, ask, claims);
  } else if (methods.closed) {
    SixQuestion six =
        methods.closed->question(ask.seed, ask.bounds.lower, ask.bounds.upper, ask.tolerance);
    SixBranches found;
    methods.closed->branches(ask.goal, 0, six, found);
    add_branches(*methods.closed, found, 0, ask.arm.dof(), claims);
    // Where an added joint may share a turn with the arm's, only one of infinitely many was seen.
    claims.beyond.complete = !methods.closed->has_added_joints() || found.continuum == 0;
    claims.beyond.doubtful |= !methods.closed_is_sure || nearly_found(*methods.closed, found);
  } else if (methods.general) {
    return solve_general(*methods.general, ask, result);
  }
  claims.beyond.complete = claims.beyond.complete && !claims.beyond.doubtful;
  result.singular = claims.beyond.continuum && !result.solutions.empty();
  return claims.beyond;
}

}  // namespace beeline
