#pragma once

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// The task of one step in dimensionless form: A x = c with A = S J W, c = S v and q̇ = W x.
///   W = diag(weight): the velocity limits, or 1 rad/s or m/s for a joint without one; at most 1e6
///   S = diag(scale): 1 / unit_of_length(arm) for translations, 1 for rotations, and 0 for the rows
///   that the task excludes
class WeightedTask {
 public:
  using Rows = Eigen::Matrix<double, 6, 1>;

  WeightedTask(const Arm& arm, const Task& task);

  /// Sets A at q. Returns world_T_tool.
  Pose set_configuration(const ConfigurationRef& q);
  /// Sets c from the command in m/s and rad/s. Returns whether c is not zero. Throws Error when the
  /// task's rows of the command are not finite.
  bool set_command(const Twist& command);
  bool set(const ConfigurationRef& q, const Twist& command) {
    set_configuration(q);
    return set_command(command);
  }

  const Jacobian& matrix() const { return matrix_; }         ///< A
  const Rows& command() const { return command_; }           ///< c
  const Eigen::VectorXd& weight() const { return weight_; }  ///< the diagonal of W
  const Arm& arm() const { return arm_; }

  /// Returns S J̇ q̇ for motion along this joint velocity q̇, by a forward difference.
  Rows derivative(const ConfigurationRef& q, const Eigen::VectorXd& velocity);

  /// Returns u̇^T (A x) for a left singular vector u of A with singular value 0, for motion along
  /// the velocity of the last derivative(): from u^T A = 0 follows u̇^T A = -u^T Ȧ.
  double lost_direction_rate(const Rows& u, const Eigen::VectorXd& x) const;

  /// Returns the scale of the command that this velocity achieves: the projection of A x on c, in
  /// units of c, clamped to [0, 1].
  double achieved_scale(const Eigen::VectorXd& velocity) const;

 private:
  Arm arm_;
  Task task_;
  Rows scale_, command_;
  Eigen::VectorXd weight_;
  Jacobian matrix_;
  Jacobian jacobian_;     ///< J at q; after derivative(), at q + step_ * velocity
  Eigen::VectorXd next_;  ///< the configuration q + step_ * velocity
  double step_ = 0;       ///< seconds
};

}  // namespace beeline::internal
