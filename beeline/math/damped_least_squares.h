#pragma once

#include <Eigen/Core>

namespace beeline::internal {

/// Returns y = (J J^T + damping I)^-1 e. x = J^T y is the step of damped least squares,
///   minimise |J x - e|^2 + damping |x|^2
/// (Levenberg 1944; for arms Nakamura & Hanafusa 1986). `damping` is above zero and has the unit of
/// J squared. The matrix has as many rows as J, so the cost is linear in the number of columns.
/// Factorises L D L^T without pivoting, as solve_damped() in symmetric6_lanes-inl.h does for eight
/// at once.
Eigen::Matrix<double, 6, 1> damped_multipliers(
    const Eigen::Matrix<double, 6, Eigen::Dynamic>& jacobian,
    const Eigen::Matrix<double, 6, 1>& error, double damping);

/// Returns the step x itself, J^T (J J^T + damping I)^-1 e, of a J of at most six rows.
Eigen::VectorXd damped_least_squares(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& error,
                                     double damping);

}  // namespace beeline::internal
