#include <algorithm>

#include <beeline/math/damped_least_squares.h>

namespace beeline::internal {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using SixRows = Eigen::Matrix<double, 6, Eigen::Dynamic>;

Vector6 damped_multipliers(const SixRows& jacobian, const Vector6& error, double damping) {
  Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Zero();  // then its factors
  for (Eigen::Index k = 0; k < jacobian.cols(); ++k) {
    const Vector6 column = jacobian.col(k);
    a.noalias() += column * column.transpose();
  }
  Vector6 y = error;
  for (int j = 0; j < 6; ++j) {
    // In exact arithmetic no pivot is below the damping.
    const double pivot = 1 / std::max(a(j, j) + damping, damping);
    a(j, j) = pivot;
    for (int i = j + 1; i < 6; ++i) {
      const double scaled = a(i, j) * pivot;
      y[i] -= scaled * y[j];
      for (int k = j + 1; k <= i; ++k) a(i, k) -= scaled * a(k, j);
    }
    for (int i = j + 1; i < 6; ++i) a(i, j) *= pivot;
  }
  for (int j = 5; j >= 0; --j) {
    y[j] *= a(j, j);
    for (int i = j + 1; i < 6; ++i) y[j] -= a(i, j) * y[i];
  }
  return y;
}

Eigen::VectorXd damped_least_squares(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& error,
                                     double damping) {
  SixRows six = SixRows::Zero(6, jacobian.cols());
  six.topRows(jacobian.rows()) = jacobian;
  Vector6 left = Vector6::Zero();
  left.head(error.size()) = error;
  return six.transpose() * damped_multipliers(six, left, damping);
}

}  // namespace beeline::internal
