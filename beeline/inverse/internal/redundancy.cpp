#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include <beeline/inverse/internal/redundancy.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline::internal {
namespace {

/// What a posture costs: its value, and per joint the slope and the curvature.
struct Cost {
  double value = 0;
  Configuration slope, curvature;
};

Cost distance_from_seed(const Request& request, const Configuration& q) {
  const Configuration away = q - request.seed;
  return {away.squaredNorm() / 2, away, Configuration::Ones(q.size())};
}

/// A high power stands for the largest share of its half range that a joint is off the middle.
Cost nearness_to_limits(const Request& request, const Configuration& q) {
  constexpr int power = 8;
  constexpr double stiffness = 1e-3;  // keeps steps finite where nothing is near a limit
  Cost cost{0, Configuration::Zero(q.size()), Configuration::Constant(q.size(), stiffness)};
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double half = (request.bounds.upper[k] - request.bounds.lower[k]) / 2;
    if (!std::isfinite(half) || !(half > 0)) continue;
    const double share = position_in_range(q[k], request.bounds.lower[k], request.bounds.upper[k]);
    cost.value += std::pow(share, power);
    cost.slope[k] = power * std::pow(share, power - 1) / half;
    cost.curvature[k] += power * (power - 1) * std::pow(share, power - 2) / (half * half);
  }
  return cost;
}

Cost cost_at(const Request& request, const Configuration& q) {
  return request.options.redundancy == Redundancy::nearest ? distance_from_seed(request, q)
                                                           : nearness_to_limits(request, q);
}

/// The step in the null space that takes the cost's quadratic model to its least. A joint on a
/// bound that the step would leave stands still.
Configuration step_downhill(const Request& request, const Configuration& q, const Cost& cost) {
  const Eigen::MatrixXd jacobian = task_jacobian(request.arm, q, request.task);
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (request.bounds.lower[k] < request.bounds.upper[k]) free.push_back(k);
  }
  while (true) {
    Configuration step = Configuration::Zero(q.size());
    const Eigen::MatrixXd moves = jacobian(Eigen::all, free);
    const Eigen::FullPivLU<Eigen::MatrixXd> factor(moves);
    if (free.empty() || factor.dimensionOfKernel() == 0) return step;
    const Eigen::MatrixXd rest = factor.kernel();
    const Configuration curvature = cost.curvature(free), slope = cost.slope(free);
    const Eigen::MatrixXd bent = rest.transpose() * curvature.asDiagonal() * rest;
    step(free) = -rest * bent.ldlt().solve(rest.transpose() * slope);
    const std::size_t before = free.size();
    std::erase_if(free, [&](Eigen::Index k) {
      return (q[k] <= request.bounds.lower[k] && step[k] < 0) ||
             (q[k] >= request.bounds.upper[k] && step[k] > 0);
    });
    if (free.size() == before) return step;
  }
}

/// What is wanted in the end, less being better.
double loss(const Request& request, const Configuration& q) {
  if (request.options.redundancy == Redundancy::nearest) return (q - request.seed).norm();
  double least = 1;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    least = std::min(least, limit_margin(q[k], request.bounds.lower[k], request.bounds.upper[k]));
  }
  return -least;
}

}  // namespace

void settle(const Request& request, InverseResult& result) {
  const NumericalResult from_seed =
      levenberg_marquardt(request.arm, request.goal, request.task, request.bounds, request.seed,
                          {.tolerance = request.tolerance});
  result.iterations += from_seed.iterations;
  if (from_seed.converged) confirm(request, from_seed.q, result);
  const std::vector<Configuration> found = result.solutions;
  for (const Configuration& q : found) result.solutions.push_back(settled(request, q));
  result.solutions = {*std::min_element(result.solutions.begin(), result.solutions.end(),
                                        [&request](const Configuration& a, const Configuration& b) {
                                          return loss(request, a) < loss(request, b);
                                        })};
}

Configuration settled(const Request& request, const Configuration& q) {
  Configuration best = q;
  Cost cost = cost_at(request, best);
  constexpr int rounds = 100;
  constexpr double still = 1e-8;  // of a step: radians or metres
  for (int round = 0; round < rounds; ++round) {
    const Configuration step = step_downhill(request, best, cost);
    bool moved = false;
    for (double share = 1; !moved && share * step.norm() > still; share /= 2) {
      const Configuration next =
          (best + share * step).cwiseMax(request.bounds.lower).cwiseMin(request.bounds.upper);
      const NumericalResult back =
          levenberg_marquardt(request.arm, request.goal, request.task, request.bounds, next,
                              {.tolerance = request.tolerance});
      if (!back.converged || !within(request.bounds, back.q)) continue;
      const Cost there = cost_at(request, back.q);
      if (!(there.value < cost.value) || error_at(request, back.q) > request.tolerance) continue;
      moved = true;
      best = back.q;
      cost = there;
    }
    if (!moved || std::chrono::steady_clock::now() >= request.deadline) break;
  }
  return best;
}

}  // namespace beeline::internal
