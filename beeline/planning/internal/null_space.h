#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// Predicts the configuration next to q with the tool at `target`, within the bounds: one damped
/// Gauss-Newton step (Dellaert, *Serial Link Manipulators*, eq. 1.5) and, for a redundant arm, a
/// motion in the null space of the Jacobian away from the joint limits (Liegeois 1977),
///     dq = J^+ e + (I - J^+ J) z,   z_k = 5 |J^+ e|_inf push_from_limits(q_k).
Configuration predict_configuration(const Arm& arm, const Configuration& q, const Pose& target,
                                    const Task& task, const Bounds& bounds);

/// The push of a coordinate towards the middle of its limits, in [-1, 1]. It is 0 in the inner half
/// of the range and in an infinite range, and grows quadratically to magnitude 1 at the limit.
double push_from_limits(double q, double lower, double upper);

}  // namespace beeline::internal
