#include <algorithm>
#include <cmath>
#include <vector>

#include <beeline/inverse/internal/redundancy.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/math/minimum_norm.h>

namespace beeline::internal {
namespace {

/// A cost that is a sum over the joints, with its first and second derivatives.
struct Cost {
  double value = 0;
  Configuration slope, curvature;
};

/// Half the squared distance from the seed.
Cost squared_distance(const Request& request, const Configuration& q) {
  const double distance = distance_from_seed(request, q);
  return {distance * distance / 2, request.weights.cwiseProduct(q - request.seed), request.weights};
}

/// Returns the sum of x_k^8, where x_k in [-1, 1] is the position of coordinate k in its range: a
/// smooth approximation of max |x_k|. A higher power approximates it better, but shortens Newton's
/// steps.
Cost nearness_to_limits(const Request& request, const Configuration& q) {
  constexpr int power = 8;
  constexpr double stiffness = 1e-3;  // keeps the Hessian regular in the middle of the ranges
  Cost cost{0, Configuration::Zero(q.size()), Configuration::Constant(q.size(), stiffness)};
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double half = (request.bounds.upper[k] - request.bounds.lower[k]) / 2;
    if (!std::isfinite(half) || !(half > 0)) continue;
    const double x = position_in_range(q[k], request.bounds.lower[k], request.bounds.upper[k]);
    cost.value += std::pow(x, power);
    cost.slope[k] = power * std::pow(x, power - 1) / half;
    cost.curvature[k] += power * (power - 1) * std::pow(x, power - 2) / (half * half);
  }
  return cost;
}

Cost cost_at(const Request& request, const Configuration& q) {
  return request.redundancy == Redundancy::nearest ? squared_distance(request, q)
                                                   : nearness_to_limits(request, q);
}

/// Returns Newton's step for the cost, with gradient g and diagonal Hessian H, in the null space of
/// the task's Jacobian:
///   dq = -S (I - (J S)^+ J S) S g with S = H^-1/2.
/// A joint at a bound that the step would pass is fixed.
Configuration null_space_step(const Request& request, const Configuration& q, const Cost& cost) {
  const Eigen::MatrixXd jacobian = task_jacobian(request.arm, q, request.task);
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (request.bounds.lower[k] < request.bounds.upper[k]) free.push_back(k);
  }
  while (true) {
    Configuration step = Configuration::Zero(q.size());
    const std::size_t before = free.size();
    const Eigen::VectorXd scale = cost.curvature(free).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled =
        jacobian(Eigen::seqN(0, jacobian.rows()), free) * scale.asDiagonal();
    const Eigen::VectorXd slope = scale.cwiseProduct(cost.slope(free));
    const MinimumNormSolution moving = minimum_norm_solution(scaled, scaled * slope);
    if (moving.rank == scaled.cols()) return step;  // the null space is empty
    step(free) = -scale.cwiseProduct(slope - moving.x);
    std::erase_if(free, [&](Eigen::Index k) {
      return (q[k] <= request.bounds.lower[k] && step[k] < 0) ||
             (q[k] >= request.bounds.upper[k] && step[k] > 0);
    });
    if (free.size() == before) return step;
  }
}

/// The scale of a Newton step. The Hessian of the cost lacks the curvature of the self-motion. The
/// scale is estimated from the remainder of the last step, which was scaled by `applied` (the
/// secant method).
double first_scale(const Configuration& last, double applied, const Configuration& step) {
  constexpr double least = 0.01, most = 100;
  if (last.isZero()) return 1;
  const double curvature = (1 - step.dot(last) / last.squaredNorm()) / applied;
  return curvature > 0 ? std::clamp(1 / curvature, least, most) : 1;
}

}  // namespace

double redundancy_objective(const Request& request, const Configuration& q) {
  if (request.redundancy != Redundancy::centred) return distance_from_seed(request, q);
  double margin = 1;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    margin = std::min(margin, limit_margin(q[k], request.bounds.lower[k], request.bounds.upper[k]));
  }
  return -margin;
}

void optimise_redundancy(const Request& request, StageResult& found) {
  const NumericalResult from_seed =
      levenberg_marquardt(request.arm, request.goal, request.task, request.bounds, request.seed,
                          {.tolerance = request.tolerance});
  found.result.iterations += from_seed.iterations;
  if (from_seed.converged) add_solution(request, from_seed.q, found);
  std::vector<Configuration> candidates;
  for (const Solution& each : *found.solutions) candidates.push_back(each.q);
  for (std::size_t i = 0, count = candidates.size(); i < count; ++i) {
    candidates.push_back(optimised(request, candidates[i]));
  }
  const Configuration& best = *std::min_element(
      candidates.begin(), candidates.end(),
      [&request](const Configuration& a, const Configuration& b) {
        return redundancy_objective(request, a) < redundancy_objective(request, b);
      });
  found.solutions->resize(0);
  found.solutions->add() = {best, error_at(request, best)};
}

Configuration optimised(const Request& request, const Configuration& q) {
  Configuration best = q;
  Cost cost = cost_at(request, best);
  constexpr int rounds = 100;          // Newton's method takes far fewer steps, except along bounds
  constexpr double negligible = 1e-8;  // radians or metres: the cost is flat to rounding there
  Configuration last = Configuration::Zero(q.size());  // the previous step
  double applied = 1;                                  // its scale
  for (int round = 0; round < rounds; ++round) {
    const Configuration step = null_space_step(request, best, cost);
    bool moved = false;
    for (double scale = first_scale(last, applied, step);
         !moved && scale * step.norm() > negligible; scale /= 2) {
      const Configuration next = clamped(request.bounds, best + scale * step);
      const NumericalResult back =
          levenberg_marquardt(request.arm, request.goal, request.task, request.bounds, next,
                              {.tolerance = request.tolerance});
      if (!back.converged || !within(request.bounds, back.q)) continue;
      const Cost there = cost_at(request, back.q);
      if (!(there.value < cost.value) || error_at(request, back.q) > request.tolerance) continue;
      moved = true;
      last = step;
      applied = scale;
      best = back.q;
      cost = there;
    }
    if (!moved || request.budget.ended()) break;
  }
  return best;
}

}  // namespace beeline::internal
