#include <algorithm>

#include <beeline/inverse/internal/candidate_solutions.h>
#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/math/six_row_svd.h>

namespace beeline::internal {

namespace {

/// Whether solutions far from q in the joints may differ from it by rounding in the pose, so that
/// one of them may be within limits. This applies only if the arm has finitely many solutions.
bool next_to_a_singularity(const Request& request, const Configuration& q) {
  if (request.arm.dof() > request.task.size()) return false;
  constexpr double near = 1e-5;  // least singular value, as a fraction of the largest
  const SixRowSvd svd = six_row_svd(task_jacobian(request.arm, q, request.task));
  return svd.singular_values[q.size() - 1] < near * svd.singular_values[0];
}

}  // namespace

void CandidateSolutions::add(Configuration q, bool continuum) {
  if (!q.allFinite()) {
    evidence().doubtful = true;
    return;
  }
  evidence().continuum = evidence().continuum || continuum;
  const double error = error_at(request_, q);
  // Fraction of the arm's size. A larger error is not rounding: a virtual joint is not at zero.
  constexpr double not_a_solution = 1e-3;
  const double size = std::max(1.0, unit_of_length(request_.arm));
  if (!(error <= not_a_solution * size)) return;
  if (error > request_.tolerance / 100) {
    const NumericalResult corrected =
        levenberg_marquardt(request_.arm, request_.goal, request_.task, no_bounds(request_.arm), q,
                            {.tolerance = request_.tolerance});
    constexpr double another = 1e-2;  // radians; a larger correction leads to another branch
    if (!corrected.converged || (corrected.q - q).norm() > another) {
      evidence().doubtful = true;
      return;
    }
    q = corrected.q;
  }
  evidence().consider(request_, q);
  // A solution within limits is valid, whatever is next to it.
  const bool outside =
      excess(request_.bounds,
             nearest_representative(request_.arm, q, request_.seed, request_.bounds)) > 0;
  if (outside && !continuum && next_to_a_singularity(request_, q)) evidence().doubtful = true;
  add_solution(request_, q, found_.result, &known_);
}

}  // namespace beeline::internal
