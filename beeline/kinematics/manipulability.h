#pragma once

#include <Eigen/Core>

namespace beeline {

/// How well a Jacobian (or the rows of one that matter) turns joint motion into tool motion.
struct Dexterity {
  Eigen::VectorXd singular_values;  ///< largest first; as many as the smaller of rows and columns
  /// Yoshikawa, "Manipulability of robotic mechanisms", 1985: sqrt(det(J J^T)), the product of the
  /// singular values; 0 when there are fewer columns than rows.
  double manipulability = 0;
  double condition = 1;  ///< largest over smallest singular value; infinite at a singularity
};

/// Throws Error for an empty matrix or one that is not finite.
Dexterity dexterity(const Eigen::Ref<const Eigen::MatrixXd>& jacobian);

}  // namespace beeline
