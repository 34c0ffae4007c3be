#include <algorithm>
#include <random>

#include <beeline/internal/random_fraction.h>
#include <beeline/inverse/numerical/bounds.h>
#include <beeline/math/decompositions.h>
#include <beeline/math/revolution.h>
#include <beeline/planning/internal/independent_rows.h>

namespace beeline::internal {
namespace {

// Rows are dependent up to this fraction of the largest: descriptions of arms round right angles.
constexpr double independent = 1e-4;
constexpr int max_configurations = 4;  // the rank of a Jacobian is full at almost all of them

/// A configuration with any angles and with distances as large as the arm; limits are ignored,
/// because the rank does not depend on them.
Configuration any_configuration(const Arm& arm, double unit, std::mt19937_64& engine) {
  Configuration q(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
    q[k] = (random_fraction(engine) - 0.5) * (slides ? unit : revolution);
  }
  return q;
}

}  // namespace

Task independent_rows(const Arm& arm, const Task& task) {
  const double unit = unit_of_length(arm);
  const Eigen::Index full = std::min(task.size(), arm.dof());
  std::mt19937_64 engine(1);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> best;
  Eigen::Index rank = 0;
  for (int i = 0; i < max_configurations && rank < full; ++i) {
    const Configuration q = any_configuration(arm, unit, engine);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposition;
    decomposition.setThreshold(independent);
    decomposition.compute(task_jacobian(arm, q, task, unit).transpose());
    if (decomposition.rank() <= rank) continue;
    rank = decomposition.rank();
    best = decomposition;
  }
  if (rank == full) return task;
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < task.rows.size(); ++i) {
    if (task.rows[i]) rows.push_back(i);
  }
  Task kept{{}, task.frame};
  for (Eigen::Index i = 0; i < rank; ++i) {
    const auto row = static_cast<std::size_t>(best.colsPermutation().indices()[i]);
    kept.rows[rows[row]] = true;
  }
  return kept;
}

bool is_redundant(const Arm& arm, const Task& task) {
  return arm.dof() > independent_rows(arm, task).size();
}

}  // namespace beeline::internal
