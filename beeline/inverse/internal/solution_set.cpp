#include <algorithm>
#include <utility>

#include <beeline/inverse/internal/solution_set.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

/// Whether two solutions are one to the tolerance: the configuration halfway between them nearly
/// solves the pose too. This is the case if several solutions coincide.
bool coincide(const Request& request, const Configuration& a, const Configuration& b) {
  constexpr double near = 0.01;  // radians or metres
  // Factor on the tolerance; the solutions themselves have errors up to 1.
  constexpr double of_tolerance = 10;
  if (!same_posture(request.arm, a, b, near)) return false;
  const Configuration beside = nearest_representative(request.arm, b, a, no_bounds(request.arm));
  return error_at(request, (a + beside) / 2) <= of_tolerance * request.tolerance;
}

/// Sorts the solutions by their distance from the seed.
void sort(const Request& request, std::vector<Configuration>& solutions) {
  std::sort(solutions.begin(), solutions.end(),
            [&request](const Configuration& a, const Configuration& b) {
              const double to_a = distance_from_seed(request, a);
              const double to_b = distance_from_seed(request, b);
              if (to_a != to_b) return to_a < to_b;
              return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
            });
}

/// Keeps the first of solutions that coincide.
void merge(const Request& request, std::vector<Configuration>& solutions) {
  std::vector<Configuration> kept;
  for (Configuration& q : solutions) {
    const bool again = std::any_of(kept.begin(), kept.end(), [&](const Configuration& other) {
      return coincide(request, other, q);
    });
    if (!again) kept.push_back(std::move(q));
  }
  solutions = std::move(kept);
}

}  // namespace

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
  nearest = clamped(request.bounds, std::move(nearest));
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
  sort(request, result.solutions);
  const bool finitely_many = request.arm.dof() <= request.task.size();
  if (request.options.all && finitely_many) merge(request, result.solutions);
  if (request.options.every_turn) {
    result.solutions = every_representative(request.arm, result.solutions, request.bounds);
    std::erase_if(result.solutions,
                  [&request](const Configuration& q) {  // rounding of many turns
                    return error_at(request, q) > request.tolerance;
                  });
    sort(request, result.solutions);
  }
  if (!request.options.all) result.solutions.resize(1);
  result.residual = 0;
  for (const Configuration& q : result.solutions) {
    result.residual = std::max(result.residual, error_at(request, q));
  }
}

}  // namespace beeline::internal
