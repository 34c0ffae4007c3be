#include <algorithm>
#include <cmath>

#include <beeline/kinematics/forward.h>
#include <beeline/math/damped_least_squares.h>
#include <beeline/planning/internal/null_space.h>

namespace beeline::internal {

double push_from_limits(double q, double lower, double upper) {
  const double side = position_in_range(q, lower, upper);
  const double depth = std::max(0.0, std::abs(side) - 0.5) * 2;
  return -std::copysign(depth * depth, side);
}

Configuration predict_configuration(const Arm& arm, const Configuration& q, const Pose& target,
                                    const Task& task, const Bounds& bounds) {
  constexpr double damping = 1e-8;  // far below the squared singular values of a regular Jacobian
  constexpr double gain = 5;  // of the push: with less, joints reach their limits; with more, they
                              // move more than the tool requires
  const Eigen::MatrixXd j = task_jacobian(arm, q, task);
  const Eigen::VectorXd error = task_error(task, target, forward_kinematics(arm, q));
  Configuration step = damped_least_squares(j, error, damping);
  if (arm.dof() > task.size()) {
    Configuration push(q.size());
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      push[k] = push_from_limits(q[k], bounds.lower[k], bounds.upper[k]);
    }
    push *= gain * step.lpNorm<Eigen::Infinity>();
    step += push - damped_least_squares(j, j * push, damping);
  }
  if (!step.allFinite()) return q;
  return clamped(bounds, q + step);
}

}  // namespace beeline::internal
