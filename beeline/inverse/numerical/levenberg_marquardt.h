#pragma once

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// A box that a configuration must not leave; infinite where there is no limit.
struct Bounds {
  Configuration lower;
  Configuration upper;
};
Bounds bounds_of(const Arm& arm);
Bounds no_bounds(const Arm& arm);

/// Throws Error unless a descent can be asked for: a task with rows, in the base or tool frame, and
/// bounds that fit the arm.
void check_task(const Arm& arm, const Task& task, const Bounds& bounds);

/// The length that weighs like one radian when errors are added up: the radius of the arm's reach,
/// or 1 m where that is infinite or zero.
double unit_of_length(const Arm& arm);

struct NumericalOptions {
  double tolerance = 1e-10;  ///< the error to go below, metres and radians
  int iterations = 100;
};

struct NumericalResult {
  Configuration q;  ///< the best configuration met, always within the bounds
  Deviation error;  ///< what is left of the task at q
  int iterations = 0;
  bool converged = false;  ///< both parts of the error are within the tolerance
};

/// One run of damped least squares (Levenberg-Marquardt; Nakamura & Hanafusa 1986) from `start`,
/// which is first brought within the bounds. Each step minimises |J dq - e|^2 + damping |dq|^2
/// within the bounds: joints that would be pushed through theirs stop there, and the others are
/// solved again. Lengths, a slide's own too, count in units of unit_of_length(), so that metres and
/// radians weigh alike. Steps that do not lessen the error are taken back with more damping: it
/// never diverges, and never returns a value that is not finite. It goes on below the tolerance
/// while each step still halves the error (down to rounding at a regular solution), and gives up
/// before `iterations` where it is stuck. Cost of a step: linear in the number of joints.
/// Throws Error when start or bounds do not fit the arm, the pose or an option is not finite or
/// negative, or the task has no rows or is in Frame::space.
NumericalResult levenberg_marquardt(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                    const Bounds& bounds, const Configuration& start,
                                    const NumericalOptions& options = {});

}  // namespace beeline::internal
