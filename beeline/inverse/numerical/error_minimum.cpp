#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include <beeline/inverse/numerical/error_minimum.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

/// Half the squared error as a function of the joints that are not held.
class HalfSquare {
 public:
  HalfSquare(const Arm& arm, const Pose& goal, const Task& task, const Bounds& bounds)
      : arm_(arm),
        goal_(goal),
        task_(task),
        bounds_(bounds),
        free_(Configuration::Ones(arm.dof())) {}

  double value(const Configuration& q) const {
    return 0.5 * task_error(task_, goal_, forward_kinematics(arm_, q)).squaredNorm();
  }

  bool is_above(double least, const Configuration& q) const {
    const Deviation error = task_deviation(task_, goal_, forward_kinematics(arm_, q));
    return std::max(error.position / unit_of_length(arm_), error.orientation) > least;
  }

  /// Returns the gradient -J^T e: exact for the position, and for the orientation to first order in
  /// e.
  Configuration gradient(const Configuration& q) const { return free_.cwiseProduct(slope(q)); }

  /// Holds the joints at a bound beyond which the error decreases.
  void hold(const Configuration& q) { free_ = moving(q); }

  /// Whether the joints that are held, and no others, are at a bound beyond which the error
  /// decreases.
  bool holds(const Configuration& q) const { return free_ == moving(q); }

  Eigen::MatrixXd hessian(const Configuration& q) const {
    // Step of central differences: truncation error h^2 and rounding error 1e-16 / h, both about
    // 1e-10.
    constexpr double h = 1e-5;  // radians or metres
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(q.size(), q.size());
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      if (free_[k] == 0) continue;
      Configuration below = q, above = q;
      below[k] -= h;
      above[k] += h;
      matrix.col(k) = (gradient(above) - gradient(below)) / (2 * h);
    }
    return 0.5 * (matrix + matrix.transpose());
  }

 private:
  Configuration slope(const Configuration& q) const {
    const Eigen::VectorXd error = task_error(task_, goal_, forward_kinematics(arm_, q));
    return -task_jacobian(arm_, q, task_).transpose() * error;
  }

  /// 1 for each joint, or 0 at a bound beyond which the error decreases.
  Configuration moving(const Configuration& q) const {
    Configuration free = slope(q);
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      const bool held =
          (q[k] <= bounds_.lower[k] && free[k] > 0) || (q[k] >= bounds_.upper[k] && free[k] < 0);
      free[k] = held ? 0 : 1;
    }
    return free;
  }

  const Arm& arm_;
  const Pose& goal_;
  const Task& task_;
  const Bounds& bounds_;
  Configuration free_;  ///< 1, or 0 for a joint that is held
};

}  // namespace

bool minimise_error(const Arm& arm, const Pose& world_T_tool, const Task& task,
                    const Bounds& bounds, double least, Configuration& q) {
  constexpr int max_steps = 100;  // it converges in about ten
  // Levenberg's rule: a tenth of the damping after a step that reduces the cost, ten times the
  // damping after one that does not. At the minimum it is a Newton step, at the maximum a step too
  // short to change the cost.
  constexpr double first_damping = 1e-3, min_damping = 1e-12, max_damping = 1e6;
  constexpr double converged = 1e-15;  // relative decrease of the cost: rounding
  HalfSquare f(arm, world_T_tool, task, bounds);
  f.hold(q);
  double smallest = f.value(q), damping = first_damping;
  bool done = false;
  for (int step = 0; step < max_steps && !done && damping < max_damping; ++step) {
    if (!f.is_above(least, q)) return false;
    const Configuration slope = f.gradient(q);
    Eigen::MatrixXd matrix = f.hessian(q);
    matrix.diagonal().array() += damping;
    const Eigen::LDLT<Eigen::MatrixXd> factor(matrix);
    const Configuration next = q - factor.solve(slope);
    const bool usable = factor.isPositive() && next.allFinite();
    const double cost = usable ? f.value(next) : smallest;
    if (!(cost < smallest)) {
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
  return (done || damping >= max_damping) && f.is_above(least, q) && f.holds(q);
}

}  // namespace beeline::internal
