#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include <beeline/inverse/internal/self_motion_dimension.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/seed_table.h>
#include <beeline/math/decompositions.h>

namespace beeline::internal {
namespace {

/// Returns the rank of the task's Jacobian with lengths in units of the arm's reach.
int rank_at(const Arm& arm, const Task& task, const Configuration& q) {
  constexpr double lost = 1e-6;  // fraction of the largest singular value
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(task_jacobian(arm, q, task, unit_of_length(arm)));
  const Eigen::VectorXd& sigma = svd.singularValues();
  return static_cast<int>((sigma.array() > lost * sigma[0]).count());
}

int largest_rank(const Arm& arm, const Task& task) {
  constexpr int trials = 4;
  Splitmix random(1);
  int largest = 0;
  Configuration q(arm.dof());
  for (int trial = 0; trial < trials; ++trial) {
    for (double& value : q) value = std::numbers::pi * (2 * random.next() - 1);
    largest = std::max(largest, rank_at(arm, task, q));
  }
  return largest;
}

/// Returns the number of independent directions in which solutions are found beside q.
int directions_found(const Arm& arm, const Task& task, const Pose& goal, const Configuration& q) {
  constexpr double step = 1e-3;        // radians or metres: curvature changes directions by as much
  constexpr double tolerance = 1e-12;  // where two solutions merge, its root is the error of q
  const int trials = 4 * arm.dof();
  const double least = 0.1 * std::sqrt(trials);  // random directions give about 0.6 times the root
  const Bounds open = no_bounds(arm);
  Splitmix random(1);
  Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(arm.dof(), trials);
  for (int trial = 0; trial < trials; ++trial) {
    Configuration beside = q;
    for (double& value : beside) value += step * (2 * random.next() - 1);
    const NumericalResult back =
        levenberg_marquardt(arm, goal, task, open, beside, {.tolerance = tolerance});
    if (back.converged) differences.col(trial) = (back.q - q) / step;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(differences);
  return static_cast<int>((svd.singularValues().array() > least).count());
}

/// Returns the median of the directions found at several of the solutions.
int dimension_found(const Arm& arm, const Task& task, const Pose& goal,
                    const std::vector<Configuration>& solutions) {
  constexpr std::size_t most = 5;
  const std::size_t count = std::min(most, solutions.size());
  std::vector<int> found;
  for (std::size_t i = 0; i < count; ++i) {
    found.push_back(directions_found(arm, task, goal, solutions[i * solutions.size() / count]));
  }
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return found.empty() ? 0 : *middle;
}

}  // namespace

int self_motion_dimension(const Arm& arm, const Task& task, const Pose& world_T_tool,
                          const std::vector<Configuration>& solutions) {
  const int rank = largest_rank(arm, task);
  const auto regular = [&](const Configuration& q) { return rank_at(arm, task, q) >= rank; };
  if (rank < arm.dof() && std::any_of(solutions.begin(), solutions.end(), regular)) {
    return arm.dof() - rank;
  }
  std::vector<Configuration> singular;
  std::copy_if(solutions.begin(), solutions.end(), std::back_inserter(singular),
               [&](const Configuration& q) { return !regular(q); });
  return dimension_found(arm, task, world_T_tool, singular);
}

}  // namespace beeline::internal
