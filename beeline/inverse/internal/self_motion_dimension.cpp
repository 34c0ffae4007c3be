#include <Eigen/SVD>
#include <algorithm>
#include <numbers>

#include <beeline/inverse/internal/self_motion_dimension.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/inverse/numerical/seed_table.h>

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

}  // namespace

int self_motion_dimension(const Arm& arm, const Task& task,
                          const std::vector<Configuration>& solutions) {
  const int rank = largest_rank(arm, task);
  if (rank == arm.dof()) return 0;
  const bool regular = std::any_of(solutions.begin(), solutions.end(), [&](const Configuration& q) {
    return rank_at(arm, task, q) == rank;
  });
  return regular ? arm.dof() - rank : 0;
}

}  // namespace beeline::internal
