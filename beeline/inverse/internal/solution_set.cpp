#include <algorithm>

#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {

double error_at(const Request& request, const Configuration& q) {
  const Deviation error =
      task_deviation(request.task, request.goal, forward_kinematics(request.arm, q));
  return std::max(error.position, error.orientation);
}

void add_solution(const Request& request, const Configuration& q, InverseResult& result,
                  PostureIndex* known) {
  // A value near a singular solution is determined only to the square root of rounding, 1e-8 to
  // 1e-7.
  constexpr double slack = 1e-6;  // radians or metres
  Configuration nearest = nearest_representative(request.arm, q, request.seed, request.bounds);
  if (excess(request.bounds, nearest) > slack) return;
  nearest = nearest.cwiseMax(request.bounds.lower).cwiseMin(request.bounds.upper);
  double error = error_at(request, nearest);
  if (error > needs_no_correction(request.tolerance)) {
    // q was clamped to a bound, is ill conditioned, or lost digits because its angles are far from
    // zero.
    const Configuration& near = within(request.bounds, q) ? q : nearest;
    const NumericalResult corrected =
        levenberg_marquardt(request.arm, request.goal, request.task, request.bounds, near,
                            {.tolerance = request.tolerance});
    const double remaining = error_at(request, corrected.q);
    if (remaining < error) {
      error = remaining;
      nearest = corrected.q;
    }
  }
  if (!(error <= request.tolerance)) return;
  PostureIndex compared;
  const bool again = (known != nullptr ? *known : compared)
                         .contains(request.arm, result.solutions, result.solutions.size(), nearest);
  if (again) return;
  result.solutions.push_back(nearest);
}

void finish(const Request& request, InverseResult& result) {
  result.status = InverseStatus::solved;
  if (request.options.every_turn) {
    result.solutions = every_representative(request.arm, result.solutions, request.bounds);
    std::erase_if(result.solutions,
                  [&request](const Configuration& q) {  // rounding of many turns
                    return error_at(request, q) > request.tolerance;
                  });
  }
  std::sort(result.solutions.begin(), result.solutions.end(),
            [&request](const Configuration& a, const Configuration& b) {
              const double to_a = distance_from_seed(request, a);
              const double to_b = distance_from_seed(request, b);
              if (to_a != to_b) return to_a < to_b;
              return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
            });
  if (!request.options.all) result.solutions.resize(1);
  result.residual = 0;
  for (const Configuration& q : result.solutions) {
    result.residual = std::max(result.residual, error_at(request, q));
  }
}

}  // namespace beeline::internal
