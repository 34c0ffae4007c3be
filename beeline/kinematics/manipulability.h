#pragma once

#include <Eigen/Core>

#include <beeline/error.h>

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

}  // namespace beeline
