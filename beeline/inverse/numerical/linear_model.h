#pragma once

#include <algorithm>
#include <vector>

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// A pose to be reached within bounds, and the units of the solvers. Lengths, including the
/// coordinates of prismatic joints, are in units of unit_of_length(), so that errors and steps have
/// one unit.
struct NumericalGoal {
  const Arm& arm;
  const Pose& world_T_tool;
  const Task& task;
  const Bounds& bounds;
  double length;          ///< metres
  Eigen::VectorXd units;  ///< unit of each coordinate, radians or metres
};

/// Throws Error when the pose is not finite, the start or the bounds do not fit, or an option is
/// out of range.
NumericalGoal numerical_goal(const Arm& arm, const Pose& world_T_tool, const Task& task,
                             const Bounds& bounds, const Configuration& start,
                             const NumericalOptions& options);

/// The linear model of the task at one configuration: the error e and the Jacobian J, such that a
/// step dz changes e to e - J dz to first order. Rows that the task leaves free are zero.
struct LinearModel {
  explicit LinearModel(Eigen::Index coordinates) : columns(6, coordinates) {}

  Jacobian columns;
  Twist error = Twist::Zero();
  Deviation deviation;  ///< metres and radians
  double cost = 0;      ///< |e|^2
};
void linearise(const NumericalGoal& goal, const Configuration& q, LinearModel& at);

/// Makes q, with its linear model, the result of a run if its cost is below `least`, the least so
/// far.
inline void keep_best(const Configuration& q, const LinearModel& at,
                      const NumericalOptions& options, double& least, NumericalResult& run) {
  if (!(at.cost < least)) return;
  least = at.cost;
  run.q = q;
  run.error = at.deviation;
  run.converged = options.accepts(run.error);
}

/// A step of a linear model within the bounds, in the units of the goal. A joint that would pass a
/// bound is held there, and the step of the others is computed again for the remaining error.
struct BoundedStep {
  explicit BoundedStep(Eigen::Index coordinates)
      : step(coordinates), held(static_cast<std::size_t>(coordinates)) {}

  /// Releases all joints.
  void begin(const LinearModel& at) {
    free = at.columns;
    error = at.error;
    std::fill(held.begin(), held.end(), 0);
  }

  /// Takes the wanted step of each joint k that is not held, wanted(k), as far as the bounds allow;
  /// returns whether more joints are held now.
  template <class Wanted>
  bool take(const NumericalGoal& goal, const Configuration& q, const Wanted& wanted) {
    bool stopped = false;
    for (int k = 0; k < q.size(); ++k) {
      char& is_held = held[static_cast<std::size_t>(k)];
      if (is_held) continue;
      const double whole = wanted(k);
      step[k] = std::clamp(whole, (goal.bounds.lower[k] - q[k]) / goal.units[k],
                           (goal.bounds.upper[k] - q[k]) / goal.units[k]);
      if (step[k] == whole) continue;
      is_held = 1;
      stopped = true;
      error -= free.col(k) * step[k];
      free.col(k).setZero();
    }
    return stopped;
  }

  Jacobian free;  ///< columns of the joints that are not held
  Twist error;    ///< error that remains for these joints
  Eigen::VectorXd step;
  std::vector<char> held;
};

}  // namespace beeline::internal
