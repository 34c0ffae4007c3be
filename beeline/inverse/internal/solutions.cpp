#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/inverse/internal/solutions.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/math/decompositions.h>
#include <beeline/math/six_row_svd.h>

namespace beeline::internal {
namespace {

/// At a tolerance of at most this, two solutions coincide only next to a singular solution.
constexpr double fine_tolerance = 1e-10;

/// Whether two solutions are one to the tolerance: the configuration halfway between them nearly
/// solves the pose too. This is the case if several solutions coincide.
bool coincide(const Request& request, const Solution& a, const Solution& b) {
  constexpr double near = 0.01;  // radians or metres
  // Factor on the tolerance; the solutions themselves have errors up to 1.
  constexpr double of_tolerance = 10;
  if (!same_posture(request.arm, a.q, b.q, near)) return false;
  const Configuration beside =
      nearest_representative(request.arm, b.q, a.q, no_bounds(request.arm));
  return error_at(request, (a.q + beside) / 2) <= of_tolerance * request.tolerance;
}

void sort_by_distance(const Request& request, Solutions& solutions) {
  if (solutions.size() < 2) return;
  for (Solution& each : solutions) {
    if (std::isnan(each.distance)) each.distance = distance_from_seed(request, each.q);
  }
  const auto before = [](const Solution& a, const Solution& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return std::lexicographical_compare(a.q.begin(), a.q.end(), b.q.begin(), b.q.end());
  };
  // Closed forms add the nearest first.
  if (std::is_sorted(solutions.begin(), solutions.end(), before)) return;
  std::sort(solutions.begin(), solutions.end(), before);
}

/// Keeps the first of solutions that coincide.
void merge(const Request& request, Solutions& solutions) {
  Solution* end = solutions.begin();
  const bool fine = request.tolerance <= fine_tolerance;
  for (Solution& next : solutions) {
    const bool again =
        !(fine && next.regular) && std::any_of(solutions.begin(), end, [&](const Solution& other) {
          return !(fine && other.regular) && coincide(request, other, next);
        });
    if (again) continue;
    if (end != &next) std::swap(*end, next);
    ++end;
  }
  solutions.resize(static_cast<std::size_t>(end - solutions.begin()));
}

void add_every_turn(const Request& request, Solutions& solutions) {
  std::vector<Configuration> postures;
  for (const Solution& each : solutions) postures.push_back(each.q);
  solutions.resize(0);
  for (const Configuration& q : every_representative(request.arm, postures, request.bounds)) {
    const double error = error_at(request, q);
    if (error > request.tolerance) continue;  // rounding of many turns
    solutions.add() = {q, error};
  }
}

/// Corrects the last digits of a representative whose error is too large: it was clamped to a
/// bound, is ill conditioned, or lost digits because its angles are far from zero.
void correct(const Request& request, const Configuration& start, Solution& solution) {
  const NumericalResult corrected =
      levenberg_marquardt(request.arm, request.goal, request.task, request.bounds, start,
                          {.tolerance = request.tolerance});
  const double remaining = error_at(request, corrected.q);
  if (!(remaining < solution.error)) return;
  solution.error = remaining;
  solution.q = corrected.q;
}

}  // namespace

void UnconstrainedResult::consider(const Request& request, const Configuration& q) {
  Configuration nearest = nearest_representative(request.arm, q, request.seed, request.bounds);
  const double outside = internal::excess(request.bounds, nearest);
  if (least_outside && !(outside < excess)) return;
  least_outside = std::move(nearest);
  excess = outside;
}

double error_at(const Request& request, const ConfigurationRef& q) {
  const Deviation error =
      task_deviation(request.task, request.goal, forward_kinematics(request.arm, q));
  return std::max(error.position, error.orientation);
}

bool nearly_singular(const Request& request, const Configuration& q, double fraction) {
  const Eigen::MatrixXd j = task_jacobian(request.arm, q, request.task);
  if (j.rows() == 6 && j.cols() == 6) {
    // The least singular value is at least |det| (5 / |J|^2)^2.5, as the geometric mean of the
    // others is at most their quadratic mean. The determinant takes a tenth of the time.
    constexpr double factor = 55;  // below 5^2.5
    const double determinant = Eigen::Matrix<double, 6, 6>(j).determinant();
    if (factor * std::abs(determinant) > fraction * std::pow(j.squaredNorm(), 3)) return false;
  }
  const SixRowSvd svd = six_row_svd(j);
  return !(svd.singular_values[q.size() - 1] > fraction * svd.singular_values[0]);
}

bool add_solution(const Request& request, const ConfigurationRef& q, StageResult& found,
                  const Knowledge& known) {
  // A value near a singular solution is determined only to the square root of rounding, 1e-8 to
  // 1e-7.
  constexpr double slack = 1e-6;  // radians or metres
  Solutions& solutions = *found.solutions;
  const std::size_t before = solutions.size();
  Solution& added = solutions.add();
  added.q = q;
  if (!known.within) move_to_nearest(request.arm, request.seed, request.bounds, added.q);
  bool accepted = known.within || excess(request.bounds, added.q) <= slack;
  if (accepted) {
    if (!known.within) added.q = clamped(request.bounds, std::move(added.q));
    const bool unchanged = !std::isnan(known.error) && added.q == q;
    added.error = unchanged ? known.error : error_at(request, added.q);
    if (added.error > request.accepted_error()) {
      correct(request, within(request.bounds, q) ? Configuration(q) : added.q, added);
    }
    const auto other = [&](std::size_t i) -> const Configuration& {
      return (solutions.begin() + i)->q;
    };
    accepted = added.error <= request.tolerance &&
               !found.postures.contains(request.arm, before, other, added.q);
    added.regular = known.regular;
  }
  if (!accepted) solutions.resize(before);
  return accepted;
}

void add_candidate(const Request& request, Configuration& q, StageResult& found,
                   const Knowledge& known) {
  UnconstrainedResult& evidence = found.unconstrained;
  if (!q.allFinite()) {
    evidence.doubtful = true;
    return;
  }
  evidence.continuum = evidence.continuum || known.continuum;
  Knowledge now = known;
  if (std::isnan(now.error)) now.error = error_at(request, q);
  if (request.quick && known.within && known.regular && now.error <= request.accepted_error()) {
    Solution& added = found.solutions->add();  // the closed form gives it once
    added.q = q;
    added.error = now.error;
    added.regular = true;
    return;
  }
  // Fraction of the arm's size. A larger error is not rounding: a virtual joint is not at zero.
  constexpr double not_a_solution = 1e-3;
  const double size = std::max(1.0, unit_of_length(request.arm));
  if (!(now.error <= not_a_solution * size)) return;
  if (now.error > request.accepted_error()) {
    if (request.options.lock) {  // a correction would move the locked joint
      evidence.doubtful = true;
      return;
    }
    const NumericalResult corrected =
        levenberg_marquardt(request.arm, request.goal, request.task, no_bounds(request.arm), q,
                            {.tolerance = request.tolerance});
    constexpr double another = 1e-2;  // radians; a larger correction leads to another branch
    if (!corrected.converged || (corrected.q - q).norm() > another) {
      evidence.doubtful = true;
      return;
    }
    q = corrected.q;
    now = {.regular = known.regular};
  }
  if (!known.within && !known.continuum && !known.regular && request.finitely_many()) {
    // Solutions far from q in the joints may differ from it by rounding in the pose, so that one of
    // them may be within limits. If q is, it is valid whatever is next to it.
    constexpr double near = 1e-5;  // least singular value, as a fraction of the largest
    const Configuration nearest =
        nearest_representative(request.arm, q, request.seed, request.bounds);
    evidence.doubtful |= excess(request.bounds, nearest) > 0 && nearly_singular(request, q, near);
  }
  // run_stages() considers regular lanes again.
  if (!add_solution(request, q, found, now) && !(request.quick && known.regular)) {
    evidence.consider(request, q);
  }
}

void sort_solutions(const Request& request, Solutions& solutions) {
  sort_by_distance(request, solutions);
  if (request.options.all && request.finitely_many()) merge(request, solutions);
  if (request.options.every_turn) {
    add_every_turn(request, solutions);
    sort_by_distance(request, solutions);
  }
  if (!request.options.all && !solutions.empty()) solutions.resize(1);
}

void set_solved(const Request& request, StageResult& found) {
  Solutions& solutions = *found.solutions;
  sort_solutions(request, solutions);
  InverseResult& result = found.result;
  result.status = InverseStatus::solved;
  result.residual = 0;
  result.solutions.reserve(solutions.size());
  for (const Solution& each : solutions) {
    result.solutions.push_back(each.q);
    result.residual = std::max(result.residual, each.error);
  }
}

}  // namespace beeline::internal
