#pragma once

#include <Eigen/Cholesky>

namespace beeline::internal {

/// Returns y = (J J^T + damping I)^-1 e. x = J^T y is the step of damped least squares,
///   minimise |J x - e|^2 + damping |x|^2
/// (Levenberg 1944; for arms Nakamura & Hanafusa 1986). `damping` is above zero and has the unit of
/// J squared. The matrix has as many rows as J, so the cost is linear in the number of columns.
/// Eight at once: solve_damped() in symmetric6_lanes-inl.h.
template <typename Matrix, typename Vector>
Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1> damped_multipliers(
    const Eigen::MatrixBase<Matrix>& jacobian, const Eigen::MatrixBase<Vector>& error,
    double damping) {
  constexpr int rows = Matrix::RowsAtCompileTime;
  Eigen::Matrix<double, rows, rows> gram = jacobian * jacobian.transpose();
  gram.diagonal().array() += damping;
  return gram.ldlt().solve(error);
}

/// Returns the step x itself: J^T (J J^T + damping I)^-1 e.
template <typename Matrix, typename Vector>
Eigen::VectorXd damped_least_squares(const Eigen::MatrixBase<Matrix>& jacobian,
                                     const Eigen::MatrixBase<Vector>& error, double damping) {
  return jacobian.transpose() * damped_multipliers(jacobian, error, damping);
}

}  // namespace beeline::internal
