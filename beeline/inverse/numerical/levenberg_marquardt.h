#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/numerical/bounds.h>

namespace beeline::internal {

struct NumericalOptions {
  double tolerance = 1e-10;           ///< max position and orientation error, metres and radians
  int max_iterations = 100;           ///< max steps
  BudgetMeter& budget = unlimited();  ///< budget, which is checked before each step

  bool accepts(const Deviation& error) const {
    return error.position <= tolerance && error.orientation <= tolerance;
  }
};

struct NumericalResult {
  Configuration q;         ///< the configuration of least error that was met, within the bounds
  Deviation error;         ///< the task's error at q
  int iterations = 0;      ///< steps tried
  bool converged = false;  ///< both parts of the error are within the tolerance
};

/// Solves for a configuration at the pose by damped least squares (Levenberg-Marquardt; Nakamura &
/// Hanafusa 1986) from `start`, clamped to the bounds. Each step minimises
///   |J dq - e|^2 + damping |dq|^2   subject to the bounds,
/// where e is the task's error and the damping is proportional to |e|^2, which keeps convergence
/// quadratic (Sugihara 2011). Lengths, including the coordinates of prismatic joints, are in units
/// of unit_of_length(). A step that does not reduce |e| is rejected and the damping increased, so
/// |e| never grows and the result is always finite. Below the tolerance it iterates while each step
/// still halves |e|; above, it ends early when |e|^2 has not halved in 8 steps. The cost of a step
/// is linear in the number of joints.
/// Throws Error when start or bounds do not fit the arm, the pose or an option is not finite or
/// negative, or the task has no rows or is in Frame::space.
NumericalResult levenberg_marquardt(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                    const Bounds& bounds, const Configuration& start,
                                    const NumericalOptions& options = {});

}  // namespace beeline::internal
