#include <algorithm>

#include <beeline/certificate/internal/clearance_recovery.h>
#include <beeline/math/decompositions.h>
#include <beeline/planning/internal/clearance_exit.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline::internal {
namespace {

/// The change of q that moves the pairs to their clearances, raised by this fraction, to first
/// order.
Configuration step_apart(const std::vector<BodyDistance>& pairs, double raised) {
  const auto count = static_cast<Eigen::Index>(pairs.size());
  Eigen::MatrixXd gradients(count, pairs.front().gradient.size());
  Eigen::VectorXd missing(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const BodyDistance& pair = pairs[static_cast<std::size_t>(i)];
    gradients.row(i) = pair.gradient.transpose();
    missing[i] = (1 + raised) * pair.clearance - pair.lower;
  }
  if (!gradients.allFinite()) return Configuration::Zero(gradients.cols());
  const unsigned thin = Eigen::ComputeThinU | Eigen::ComputeThinV;
  return Eigen::JacobiSVD<Eigen::MatrixXd>(gradients, thin).solve(missing);
}

/// The configuration that the descent reaches, if all pairs keep their clearance there.
std::optional<Configuration> descent(const CollisionModel& model, const Configuration& start,
                                     double raised, BudgetMeter& budget) {
  constexpr int max_steps = 30;
  constexpr double longest_step = 0.1;  // rad or m
  Configuration q = start;
  for (int i = 0; i < max_steps; ++i) {
    constexpr std::int64_t work = 10;  // of the distances at a configuration
    if (budget.ended(work)) return std::nullopt;
    const std::vector<BodyDistance> pairs = pairs_too_close(model, q);
    if (pairs.empty()) return q;
    const Configuration step = step_apart(pairs, raised);
    q += step * std::min(1.0, longest_step / std::max(step.norm(), longest_step));
    q = nearest_within_limits(model.arm(), q);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Configuration> clearance_exit(const CollisionModel& model, const Configuration& start,
                                            double depth, BudgetMeter& budget) {
  const std::vector<BodyDistance> pairs = pairs_too_close(model, start);
  if (pairs.empty()) return std::nullopt;
  const double start_depth = pairs.front().clearance - pairs.front().lower;
  if (!may_recover_clearance(start_depth, depth) || !limit_violations(model.arm(), start).empty()) {
    return std::nullopt;
  }
  for (const double raised : {0.1, 0.5, 2.0, 10.0}) {
    const std::optional<Configuration> exit = descent(model, start, raised, budget);
    if (!exit) continue;
    const Trajectory straight{model.arm().joint_names(), {0, 1}, {start, *exit}, {}, {}};
    if (prove_clearance(model, straight, {.recover_clearance = depth, .budget = budget.part()})) {
      return exit;
    }
  }
  return std::nullopt;
}

}  // namespace beeline::internal
