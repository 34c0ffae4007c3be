#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include <beeline/inverse/internal/redundancy.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline {
namespace {

/// What a posture costs: its value, and per joint the slope and the curvature.
struct Cost {
  double value = 0;
  Configuration slope, curvature;
};

Cost distance_from_seed(const Question& ask, const Configuration& q) {
  const Configuration away = q - ask.seed;
  return {away.squaredNorm() / 2, away, Configuration::Ones(q.size())};
}

/// A high power stands for the largest share of its half range that a joint is off the middle.
Cost nearness_to_limits(const Question& ask, const Configuration& q) {
  constexpr int power = 8;
  constexpr double stiffness = 1e-3;  // keeps steps finite where nothing is near a limit
  Cost cost{0, Configuration::Zero(q.size()), Configuration::Constant(q.size(), stiffness)};
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const double half = (ask.bounds.upper[k] - ask.bounds.lower[k]) / 2;
    if (!std::isfinite(half) || !(half > 0)) continue;
    const double share = position_in_range(q[k], ask.bounds.lower[k], ask.bounds.upper[k]);
    cost.value += std::pow(share, power);
    cost.slope[k] = power * std::pow(share, power - 1) / half;
    cost.curvature[k] += power * (power - 1) * std::pow(share, power - 2) / (half * half);
  }
  return cost;
}

Cost cost_at(const Question& ask, const Configuration& q) {
  return ask.options.redundancy == Redundancy::nearest ? distance_from_seed(ask, q)
                                                       : nearness_to_limits(ask, q);
}

/// The step in the null space that takes the cost's quadratic model to its least. A joint on a
/// bound that the step would leave stands still.
Configuration step_downhill(const Question& ask, const Configuration& q, const Cost& cost) {
  const Eigen::MatrixXd jacobian = task_jacobian(ask.arm, q, ask.task);
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    if (ask.bounds.lower[k] < ask.bounds.upper[k]) free.push_back(k);
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
      return (q[k] <= ask.bounds.lower[k] && step[k] < 0) ||
             (q[k] >= ask.bounds.upper[k] && step[k] > 0);
    });
    if (free.size() == before) return step;
  }
}

/// What is wanted in the end, less being better.
double loss(const Question& ask, const Configuration& q) {
  if (ask.options.redundancy == Redundancy::nearest) return (q - ask.seed).norm();
  double least = 1;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    least = std::min(least, limit_margin(q[k], ask.bounds.lower[k], ask.bounds.upper[k]));
  }
  return -least;
}

}  // namespace

void settle(const Question& ask, InverseResult& result) {
  const Descent from_seed =
      descend(ask.arm, ask.goal, ask.task, ask.bounds, ask.seed, {.tolerance = ask.tolerance});
  result.iterations += from_seed.iterations;
  if (from_seed.converged) confirm(ask, from_seed.q, result);
  const std::vector<Configuration> found = result.solutions;
  for (const Configuration& q : found) result.solutions.push_back(settled(ask, q));
  result.solutions = {*std::min_element(result.solutions.begin(), result.solutions.end(),
                                        [&ask](const Configuration& a, const Configuration& b) {
                                          return loss(ask, a) < loss(ask, b);
                                        })};
}

Configuration settled(const Question& ask, const Configuration& q) {
  Configuration best = q;
  Cost cost = cost_at(ask, best);
  constexpr int rounds = 100;
  constexpr double still = 1e-8;  // of a step: radians or metres
  for (int round = 0; round < rounds; ++round) {
    const Configuration step = step_downhill(ask, best, cost);
    bool moved = false;
    for (double share = 1; !moved && share * step.norm() > still; share /= 2) {
      const Configuration next =
          (best + share * step).cwiseMax(ask.bounds.lower).cwiseMin(ask.bounds.upper);
      const Descent back =
          descend(ask.arm, ask.goal, ask.task, ask.bounds, next, {.tolerance = ask.tolerance});
      if (!back.converged || !within(ask.bounds, back.q)) continue;
      const Cost there = cost_at(ask, back.q);
      if (!(there.value < cost.value) || error_at(ask, back.q) > ask.tolerance) continue;
      moved = true;
      best = back.q;
      cost = there;
    }
    if (!moved || std::chrono::steady_clock::now() >= ask.deadline) break;
  }
  return best;
}

}  // namespace beeline
