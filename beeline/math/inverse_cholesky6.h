#pragma once

#include <Eigen/Core>

namespace beeline::internal {

/// Solves G y = b for a symmetric positive definite G of 6 x 6 by the inverse of its Cholesky
/// factor, y = L^-T (L^-1 b): two products without divisions or data dependencies between rows.
/// For many right sides of one matrix; damped_least_squares.h solves for a single one.
class InverseCholesky6 {
 public:
  using Vector = Eigen::Matrix<double, 6, 1>;
  using Matrix = Eigen::Matrix<double, 6, 6>;

  void factor(const Matrix& matrix);
  Vector solve(const Vector& b) const {
    const Vector half = inverse_ * b;
    return inverse_.transpose() * half;
  }

 private:
  Matrix inverse_ = Matrix::Identity();  ///< L^-1, where G = L L^T
};

}  // namespace beeline::internal
