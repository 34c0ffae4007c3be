#pragma once

#include <Eigen/Core>

#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {

/// Solves G y = b for a symmetric positive G, with the triangular factor inverted: a solution is
/// two products that wait for nothing (a servo's step needs several with the same G).
class SixByRoots {
 public:
  using Rows = Eigen::Matrix<double, 6, 1>;
  using Gram = Eigen::Matrix<double, 6, 6>;

  void factor(const Gram& gram);
  Rows solve(const Rows& b) const {
    const Rows half = root_ * b;
    return root_.transpose() * half;
  }

 private:
  Gram root_ = Gram::Identity();  ///< inverse of the Cholesky factor
};

/// Singular values of a matrix with six rows by one-sided Jacobi rotations (Hestenes 1958), in no
/// order. Started from the directions found last, it is quick where the matrix has changed little.
struct SixDirections {
  Eigen::Matrix<double, 6, 6> u = Eigen::Matrix<double, 6, 6>::Identity();  ///< columns
  Eigen::Matrix<double, Eigen::Dynamic, 6> motion;  ///< columns u_i^T rows, of length size[i]
  Eigen::Matrix<double, 6, 1> size;

  void find(const Jacobian& rows);
};

}  // namespace beeline::internal
