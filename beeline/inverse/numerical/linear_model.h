#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// A pose to be reached within bounds, and the units in which the solvers compute. Lengths, also
/// those of prismatic joints, are in units of unit_of_length(), so that errors and steps have one
/// unit.
struct NumericalGoal {
  const Arm& arm;
  const Pose& world_T_tool;
  const Task& task;
  const Bounds& bounds;
  double length;          ///< metres
  Eigen::VectorXd units;  ///< of each coordinate, radians or metres
};

/// Throws Error when the pose is not finite, the bounds do not fit, or an option is out of range.
NumericalGoal numerical_goal(const Arm& arm, const Pose& world_T_tool, const Task& task,
                             const Bounds& bounds, const NumericalOptions& options);

/// The linear model of the task at one configuration: the error e and the Jacobian J, such that a
/// step dz changes e to e - J dz to first order. Rows that the task leaves free are zero.
struct LinearModel {
  Jacobian columns;
  Twist error = Twist::Zero();
  Deviation deviation;  ///< metres and radians
  double cost = 0;      ///< |e|^2
};
void linearise(const NumericalGoal& goal, const Configuration& q, LinearModel& at);

}  // namespace beeline::internal
