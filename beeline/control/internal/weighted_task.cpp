#include <algorithm>

#include <beeline/control/internal/weighted_task.h>
#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

WeightedTask::WeightedTask(const Arm& arm, const Task& task)
    : arm_(arm),
      task_(task),
      weight_(arm.dof()),
      matrix_(6, arm.dof()),
      jacobian_(6, arm.dof()),
      next_(arm.dof()) {
  for (int i = 0; i < 6; ++i) {
    scale_[i] = !task.rows[i] ? 0 : i < 3 ? 1 / unit_of_length(arm) : 1;
  }
  constexpr double max_weight = 1e6;  // squares of much larger weights overflow
  for (int k = 0; k < arm.dof(); ++k) {
    weight_[k] = std::min(velocity_limit_of(arm.limits(k)), max_weight);
  }
}

Pose WeightedTask::set_configuration(const ConfigurationRef& q) {
  const Pose world_T_tool = jacobian(arm_, q, jacobian_, task_.frame);
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    matrix_.col(k) = weight_[k] * scale_.cwiseProduct(jacobian_.col(k));
  }
  return world_T_tool;
}

bool WeightedTask::set_command(const Twist& command) {
  for (int i = 0; i < 6; ++i) command_[i] = scale_[i] > 0 ? scale_[i] * command[i] : 0;
  constexpr double max_command = 1e100;  // squares of larger numbers overflow
  if (!command_.allFinite() || !(command_.lpNorm<Eigen::Infinity>() < max_command)) {
    throw Error("the command must be finite and below 1e100");
  }
  return command_.squaredNorm() > 0;
}

WeightedTask::Rows WeightedTask::derivative(const ConfigurationRef& q,
                                            const Eigen::VectorXd& velocity) {
  // Radians or metres. The truncation error is of this order and the rounding error is 1e-16 /
  // 1e-5; both are negligible in a bound on accelerations.
  constexpr double difference = 1e-5;
  step_ = difference / std::max(velocity.lpNorm<Eigen::Infinity>(), 1e-300);
  next_ = q + step_ * velocity;
  jacobian(arm_, next_, jacobian_, task_.frame);
  Rows here = Rows::Zero(), ahead = Rows::Zero();
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    here += velocity[k] / weight_[k] * matrix_.col(k);
    ahead += velocity[k] * jacobian_.col(k);
  }
  return (scale_.cwiseProduct(ahead) - here) / step_;
}

double WeightedTask::lost_direction_rate(const Rows& u, const Eigen::VectorXd& x) const {
  double moved = 0;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    moved += x[k] * weight_[k] * u.dot(scale_.cwiseProduct(jacobian_.col(k)));
  }
  return -moved / step_;
}

double WeightedTask::achieved_scale(const Eigen::VectorXd& velocity) const {
  Rows sum = Rows::Zero();
  for (Eigen::Index k = 0; k < velocity.size(); ++k) {
    sum += velocity[k] / weight_[k] * matrix_.col(k);
  }
  return std::clamp(sum.dot(command_) / command_.squaredNorm(), 0.0, 1.0);
}

}  // namespace beeline::internal
