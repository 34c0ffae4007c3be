#pragma once

#include <Eigen/Core>

namespace beeline::internal {

/// Singular value decomposition of a 6 x n matrix A by one-sided Jacobi rotations (Hestenes 1958),
/// singular values in no order. compute() starts from the last result, so that it is quick for a
/// matrix that has changed little. Does not allocate when `scaled_right` has n rows.
struct SixRowSvd {
  Eigen::Matrix<double, 6, 6> left = Eigen::Matrix<double, 6, 6>::Identity();  ///< columns u_i
  Eigen::Matrix<double, Eigen::Dynamic, 6> scaled_right;  ///< columns A^T u_i = sigma_i v_i
  Eigen::Matrix<double, 6, 1> singular_values;

  void compute(const Eigen::Matrix<double, 6, Eigen::Dynamic>& a);
};

/// Returns the decomposition of a matrix of at most six rows, extended by rows of zeros, singular
/// values in decreasing order.
SixRowSvd six_row_svd(const Eigen::Ref<const Eigen::MatrixXd>& a);

/// Returns the largest singular value that is zero, to rounding, in a matrix of at most `size` rows
/// and columns whose largest one is `largest`.
double negligible_singular_value(double largest, Eigen::Index size);

}  // namespace beeline::internal
