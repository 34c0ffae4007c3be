#pragma once

#include <beeline/kinematics/task.h>

namespace beeline {

/// A box that a configuration must not leave; infinite where there is no limit.
struct Bounds {
  Configuration lower;
  Configuration upper;
};
Bounds bounds_of(const Arm& arm);
Bounds no_bounds(const Arm& arm);

struct DescentOptions {
  double tolerance = 1e-10;  ///< the error to go below, metres and radians
  int iterations = 100;
};

struct Descent {
  Configuration q;  ///< the best configuration met, always within the bounds
  Deviation error;  ///< what is left of the task at q
  int iterations = 0;
  bool converged = false;
};

/// One run of damped least squares (Levenberg-Marquardt; Nakamura & Hanafusa 1986) from `start`:
/// each step minimises |J dq - e|^2 + damping |dq|^2 over the joints that are free to move, those
/// at a bound that would push through it being held. Steps that do not lessen the error are taken
/// back with more damping, so it never diverges and never returns a value that is not finite.
Descent descend(const Arm& arm, const Pose& world_T_tool, const Task& task, const Bounds& bounds,
                const Configuration& start, const DescentOptions& options = {});

}  // namespace beeline
