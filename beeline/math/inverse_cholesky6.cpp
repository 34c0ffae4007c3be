#include <cmath>

#include <beeline/math/inverse_cholesky6.h>

namespace beeline::internal {

void InverseCholesky6::factor(const Matrix& matrix) {
  Matrix remainder = matrix;
  inverse_.setIdentity();
  for (int i = 0; i < 6; ++i) {  // each step eliminates a column below the diagonal
    const double scale = 1 / std::sqrt(remainder(i, i));
    Vector column = remainder.col(i) * scale;
    Eigen::Matrix<double, 1, 6> row = inverse_.row(i) * scale;
    column.head(i + 1).setZero();
    inverse_.row(i) = row;
    remainder.noalias() -= column * column.transpose();
    inverse_.noalias() -= column * row;
  }
}

}  // namespace beeline::internal
