#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline {

/// A first guess for the configuration next to q that brings the tool to `target`: one damped
/// Newton step (the chapter's eq. 1.5), plus, where joints are redundant, a motion in the
/// Jacobian's null space that keeps them from their limits (Liegeois 1977). Always within the
/// bounds.
Configuration predicted(const Arm& arm, const Configuration& q, const Pose& target,
                        const Task& task, const internal::Bounds& bounds);

/// Which way, from -1 to 1, and how urgently a coordinate at q should go back to the middle of its
/// limits: 0 in the inner half of the range and where it has no end, growing with the square to 1
/// at the limit.
double push_from_limits(double q, double lower, double upper);

/// The damped pseudo-inverse applied to a task-space step: J^T (J J^T + damping^2 I)^-1 e.
Eigen::VectorXd damped_solve(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& error,
                             double damping);

}  // namespace beeline
