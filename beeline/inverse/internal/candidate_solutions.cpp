#include <algorithm>

#include <beeline/inverse/internal/candidate_solutions.h>
#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

void CandidateSolutions::add(Configuration q, bool continuum) {
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
  add_solution(request_, q, found_.result, &known_);
}

}  // namespace beeline::internal
