#pragma once

#include <Eigen/Core>

#include <beeline/error.h>

namespace beeline {

/// Measures of a Jacobian's distance from singularity.
struct Dexterity {
  Eigen::VectorXd singular_values;  ///< in decreasing order, min(rows, columns) of them
  /// sqrt(det(J J^T)), the product of the singular values; 0 with fewer columns than rows
  /// (Yoshikawa, "Manipulability of robotic mechanisms", 1985).
  double manipulability = 0;
  double condition = 1;  ///< largest over smallest singular value; infinite at a singularity
};

/// Returns the measures of a Jacobian, or of some of its rows. Linear and angular rows have
/// different units: scale one of them first where the condition number matters (task_jacobian()).
/// Throws Error for an empty matrix, one of more than six rows, or one that is not finite.
Dexterity dexterity(const Eigen::Ref<const Eigen::MatrixXd>& jacobian);

}  // namespace beeline
