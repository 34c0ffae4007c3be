#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>

#include <beeline/inverse/numerical/linear_model.h>
#include <beeline/inverse/numerical/singular_configuration.h>

namespace beeline::internal {
namespace {

/// Returns the columns of the derivative of J with respect to coordinate k, by a central
/// difference. Its error, 1e-10, slows the convergence by as much.
Jacobian jacobian_change(const NumericalGoal& goal, const Configuration& q, int k) {
  constexpr double h = 1e-5;  // radians, or units of length
  LinearModel above(q.size()), below(q.size());
  Configuration moved = q;
  moved[k] = q[k] + h * goal.units[k];
  linearise(goal, moved, above);
  moved[k] = q[k] - h * goal.units[k];
  linearise(goal, moved, below);
  return (above.columns - below.columns) / (2 * h);
}

/// Returns Newton's step, in the units of the goal. Singular values below this fraction of the
/// largest count as lost.
Eigen::VectorXd newton_step(const NumericalGoal& goal, const Configuration& q,
                            const LinearModel& at, double nearly_lost) {
  const Eigen::Index n = q.size();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(at.columns,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::VectorXd& sigma = svd.singularValues();
  Eigen::Index rank = sigma.size() - 1;
  while (rank > 1 && sigma[rank - 1] < nearly_lost * sigma[0]) --rank;
  const Eigen::Index lost = sigma.size() - rank, still = n - rank;
  const Eigen::MatrixXd moving = svd.matrixU().leftCols(rank).transpose();
  const Eigen::MatrixXd null_space = svd.matrixV().rightCols(still);
  Eigen::MatrixXd a(rank + lost * still, n);
  Eigen::VectorXd b(a.rows());
  a.topRows(rank) = moving * at.columns;
  b.head(rank) = moving * at.error;
  for (Eigen::Index i = 0; i < lost; ++i) {
    const Twist u = svd.matrixU().col(rank + i);
    b.segment(rank + i * still, still) = -null_space.transpose() * (at.columns.transpose() * u);
  }
  for (int k = 0; k < n; ++k) {
    const Jacobian change = jacobian_change(goal, q, k);
    for (Eigen::Index i = 0; i < lost; ++i) {
      const Twist u = svd.matrixU().col(rank + i);
      a.block(rank + i * still, k, still, 1) = null_space.transpose() * (change.transpose() * u);
    }
  }
  return Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(a).solve(b);
}

/// Runs Newton's method with one threshold for lost singular values.
NumericalResult run_newton(const NumericalGoal& goal, const Configuration& start,
                           double nearly_lost, const NumericalOptions& options) {
  constexpr int max_steps = 12;  // a start that needs more is not near
  constexpr double longest = 0.5;
  LinearModel at(start.size());
  NumericalResult run;
  Configuration q = clamped(goal.bounds, start);
  for (double least = Limits::none;; ++run.iterations) {
    linearise(goal, q, at);
    keep_best(q, at, options, least, run);
    if (run.converged || run.iterations == std::min(max_steps, options.max_iterations) ||
        !std::isfinite(at.cost) || options.budget.ended()) {
      return run;
    }
    Eigen::VectorXd step = newton_step(goal, q, at, nearly_lost);
    if (!step.allFinite()) return run;
    if (step.norm() > longest) step *= longest / step.norm();
    q = clamped(goal.bounds, q + goal.units.cwiseProduct(step));
  }
}

}  // namespace

NumericalResult singular_configuration(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                       const Bounds& bounds, const Configuration& start,
                                       const NumericalOptions& options) {
  const NumericalGoal goal = numerical_goal(arm, world_T_tool, task, bounds, start, options);
  NumericalResult best;
  int iterations = 0;
  // A small singular value may belong to a second singularity nearby that the solution does not
  // have.
  for (const double nearly_lost : {0.02, 0.002}) {
    NumericalResult run = run_newton(goal, start, nearly_lost, options);
    iterations += run.iterations;
    const auto size = [](const Deviation& e) { return std::max(e.position, e.orientation); };
    if (best.q.size() == 0 || size(run.error) < size(best.error)) best = std::move(run);
    if (best.converged || options.budget.ended(0)) break;
  }
  best.iterations = iterations;
  return best;
}

}  // namespace beeline::internal
