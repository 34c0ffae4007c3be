#pragma once

#include <Eigen/Core>

#include <beeline/error.h>
#include <beeline/kinematics/task.h>

namespace beeline {

/// Measures of a Jacobian's distance from singularity (Lynch & Park, "Modern Robotics", 2017,
/// section 5.4).
struct ManipulabilityMeasures {
  Eigen::VectorXd singular_values;  ///< in decreasing order, min(rows, columns) of them
  /// sqrt(det(J J^T)), the product of the singular values; 0 with fewer columns than rows
  /// (Yoshikawa, "Manipulability of robotic mechanisms", 1985).
  double manipulability = 0;
  /// The condition number: largest over smallest singular value; infinite at a singularity. Branch
  /// and PathMotion have its reciprocal, the inverse condition number.
  double condition = 1;
};

/// Returns the measures of a Jacobian, or of some of its rows. Linear and angular rows have
/// different units: scale one of them first where the condition number matters (task_jacobian()).
/// Throws Error for an empty matrix, one of more than six rows, or one that is not finite.
ManipulabilityMeasures manipulability_measures(const Eigen::Ref<const Eigen::MatrixXd>& jacobian);

/// The velocities J dq of all joint velocities with |dq| = 1, and the forces F of all joint torques
/// with |J^T F| = 1 (Lynch & Park, section 5.4). Both ellipsoids have the same axes.
struct ManipulabilityEllipsoids {
  Eigen::MatrixXd axes;      ///< principal axes: orthonormal columns, as many as the rows of J
  Eigen::VectorXd velocity;  ///< semi-axes, in decreasing order; 0 along which nothing moves
  Eigen::VectorXd force;     ///< their reciprocals; infinite where the velocity is 0
};

/// Returns the ellipsoids of a Jacobian, or of some of its rows; take linear or angular rows, as
/// their units differ. Throws Error as manipulability_measures() does.
ManipulabilityEllipsoids manipulability_ellipsoids(
    const Eigen::Ref<const Eigen::MatrixXd>& jacobian);

/// Yoshikawa's measure and its derivatives.
struct ManipulabilityGradient {
  double manipulability = 0;  ///< as in ManipulabilityMeasures
  /// With respect to the coordinates, per radian or metre. Zero where the measure is 0, as it has
  /// no derivatives there in general.
  Configuration gradient;
};

/// Returns the manipulability of the task's rows and its gradient: of all rows Task::spatial(), of
/// the translational ones Task::position(), of the rotational ones the mask 000111. The gradient is
/// w tr(J^+ dJ/dq), by Jacobi's formula for the derivative of det(J J^T). Throws Error as
/// jacobian() and check_task() do.
ManipulabilityGradient manipulability_gradient(const Arm& arm, const ConfigurationRef& q,
                                               const Task& task = Task::spatial());

}  // namespace beeline
