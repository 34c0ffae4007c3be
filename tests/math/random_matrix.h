#pragma once

#include <Eigen/QR>
#include <algorithm>

#include <tests/random.h>

namespace beeline::testing {

inline Eigen::MatrixXd random_matrix(Random& random, int rows, int cols) {
  return Eigen::MatrixXd::NullaryExpr(
      rows, cols, [&](Eigen::Index, Eigen::Index) { return random.uniform(-1, 1); });
}

inline Eigen::MatrixXd random_orthogonal(Random& random, int size) {
  return random_matrix(random, size, size).householderQr().householderQ();
}

/// A matrix whose singular values are `rank` numbers from 0.1 to 10, and zeros.
inline Eigen::MatrixXd random_matrix_of_rank(Random& random, int rows, int cols, int rank) {
  Eigen::MatrixXd diagonal = Eigen::MatrixXd::Zero(rows, cols);
  for (int i = 0; i < rank; ++i) diagonal(i, i) = random.uniform(0.1, 10);
  if (cols == 0) return diagonal;
  return random_orthogonal(random, rows) * diagonal * random_orthogonal(random, cols);
}

}  // namespace beeline::testing
