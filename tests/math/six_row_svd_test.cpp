#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

#include <beeline/math/decompositions.h>
#include <beeline/math/six_row_svd.h>

#include <tests/math/random_matrix.h>

namespace beeline {
namespace {

using testing::random_matrix_of_rank;

/// A^T U = the right vectors times the singular values, U orthogonal, values in decreasing order.
void expect_decomposition(const Eigen::MatrixXd& a, double scale) {
  const internal::SixRowSvd svd = internal::six_row_svd(scale * a);
  const Eigen::MatrixXd left = svd.left.topRows(a.rows());
  const Eigen::MatrixXd right = svd.scaled_right / scale;
  ASSERT_TRUE((svd.left.transpose() * svd.left).isIdentity(1e-13));
  ASSERT_LT((a.transpose() * left - right).norm(), 1e-13 * (1 + a.norm()));
  Eigen::MatrixXd gram = right.transpose() * right;
  gram.diagonal().setZero();
  ASSERT_LT(gram.norm(), 1e-12 * (1 + a.squaredNorm()));
  for (int i = 0; i < 6; ++i) {
    ASSERT_NEAR(svd.singular_values[i] / scale, right.col(i).norm(), 1e-13 * (1 + a.norm()));
    ASSERT_LE(svd.singular_values[i], svd.singular_values[std::max(0, i - 1)]);
  }
}

TEST(SixRowSvd, HasEigensSingularValuesAndOrthogonalVectors) {
  testing::Random random;
  for (int rows = 1; rows <= 6; ++rows) {
    for (int cols = 0; cols <= 12; ++cols) {
      for (int rank = 0; rank <= std::min(rows, cols); ++rank) {
        SCOPED_TRACE(::testing::Message() << rows << " x " << cols << ", rank " << rank);
        const Eigen::MatrixXd a = random_matrix_of_rank(random, rows, cols, rank);
        Eigen::VectorXd expected = Eigen::VectorXd::Zero(6);
        if (cols > 0) expected.head(std::min(rows, cols)) = a.jacobiSvd().singularValues();
        for (const double scale : {1e-100, 1.0, 1e100, 1e300}) {
          const Eigen::VectorXd values = internal::six_row_svd(scale * a).singular_values / scale;
          ASSERT_LT((values - expected).norm(), 1e-13 * (1 + a.norm()));
          ASSERT_NO_FATAL_FAILURE(expect_decomposition(a, scale));
        }
      }
    }
  }
}

TEST(SixRowSvd, StartsFromTheLastResult) {
  testing::Random random;
  Eigen::MatrixXd a = random_matrix_of_rank(random, 6, 7, 6);
  internal::SixRowSvd svd;
  for (int i = 0; i < 100; ++i) {
    a += testing::random_matrix(random, 6, 7) / 100;
    svd.compute(a);
    Eigen::VectorXd values = svd.singular_values;
    std::sort(values.begin(), values.end(), std::greater<>());
    ASSERT_LT((values - a.jacobiSvd().singularValues()).norm(), 1e-13 * a.norm());
  }
}

}  // namespace
}  // namespace beeline
