#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include <beeline/inverse/numerical/error_minimum.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

/// Half the squared error as a function of the joints that are not held.
struct HalfSquare {
  const Arm& arm;
  const Pose& goal;
  const Task& task;
  const Bounds& bounds;
  Configuration free = Configuration::Ones(arm.dof());  ///< 1, or 0 for a joint that is held

  double value(const Configuration& q) const {
    return 0.5 * task_error(task, goal, forward_kinematics(arm, q)).squaredNorm();
  }

  bool is_above(double least, const Configuration& q) const {
    const Deviation error = task_deviation(task, goal, forward_kinematics(arm, q));
    return std::max(error.position / unit_of_length(arm), error.orientation) > least;
  }

  /// Returns the gradient -J^T e of all joints: exact for the position, and for the orientation to
  /// first order in e.
  Configuration slope(const Configuration& q) const {
    const Eigen::VectorXd error = task_error(task, goal, forward_kinematics(arm, q));
    return -task_jacobian(arm, q, task).transpose() * error;
  }

  /// Returns 1 for each joint, or 0 at a bound beyond which the error decreases.
  Configuration not_pressed(const Configuration& q) const {
    const Configuration s = slope(q);
    const Eigen::Array<bool, Eigen::Dynamic, 1> held =
        (q.array() <= bounds.lower.array() && s.array() > 0) ||
        (q.array() >= bounds.upper.array() && s.array() < 0);
    return held.select(Configuration::Zero(q.size()), Configuration::Ones(q.size()));
  }

  Eigen::MatrixXd hessian(const Configuration& q) const {
    // Step of central differences: truncation error h^2 and rounding error 1e-16 / h, both about
    // 1e-10.
    constexpr double h = 1e-5;  // radians or metres
    Eigen::MatrixXd matrix(q.size(), q.size());
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      const Configuration step = h * Configuration::Unit(q.size(), k);
      matrix.col(k) = free[k] / (2 * h) * free.cwiseProduct(slope(q + step) - slope(q - step));
    }
    return 0.5 * (matrix + matrix.transpose());
  }
};

}  // namespace

bool minimise_error(const Arm& arm, const Pose& world_T_tool, const Task& task,
                    const Bounds& bounds, double least, BudgetMeter& budget, Configuration& q) {
  constexpr int max_steps = 100;  // it converges in about ten
  // Levenberg's rule: a tenth of the damping after a step that reduces the cost, ten times the
  // damping after one that does not. At the minimum it is a Newton step, at the maximum a step too
  // short to change the cost.
  constexpr double first_damping = 1e-3, min_damping = 1e-12, max_damping = 1e6;
  constexpr double converged = 1e-15;  // relative decrease of the cost: rounding
  HalfSquare f{arm, world_T_tool, task, bounds};
  f.free = f.not_pressed(q);
  double smallest = f.value(q), damping = first_damping;
  Configuration slope;
  Eigen::MatrixXd hessian;
  bool moved = true, done = false;
  for (int step = 0; step < max_steps && !done && damping < max_damping; ++step) {
    if (budget.ended()) return false;
    if (moved) {
      if (!f.is_above(least, q)) return false;
      slope = f.free.cwiseProduct(f.slope(q));
      hessian = f.hessian(q);
    }
    Eigen::MatrixXd matrix = hessian;
    matrix.diagonal().array() += damping;
    const Eigen::LDLT<Eigen::MatrixXd> factor(matrix);
    const Configuration next = q - factor.solve(slope);
    const bool usable = factor.isPositive() && next.allFinite();
    const double cost = usable ? f.value(next) : smallest;
    moved = cost < smallest;
    if (!moved) {
      damping *= 10;
      continue;
    }
    if (!within(bounds, next)) return false;
    done = smallest - cost < converged * smallest;
    q = next;
    smallest = cost;
    damping = std::max(damping / 10, min_damping);
  }
  // With the most damping, no step reduces the cost.
  return (done || damping >= max_damping) && f.is_above(least, q) && f.free == f.not_pressed(q);
}

}  // namespace beeline::internal
