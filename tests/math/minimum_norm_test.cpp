#include <gtest/gtest.h>

#include <beeline/math/minimum_norm.h>

#include <tests/math/random_matrix.h>

namespace beeline {
namespace {

using testing::random_matrix;
using testing::random_matrix_of_rank;

constexpr double scales[] = {1e-100, 1, 1e100, 1e200};

TEST(MinimumNorm, IsTheSolutionOfACompleteOrthogonalDecomposition) {
  testing::Random random;
  for (int rows = 1; rows <= 6; ++rows) {
    for (int cols = 1; cols <= 12; ++cols) {
      for (int rank = 0; rank <= std::min(rows, cols); ++rank) {
        const Eigen::MatrixXd a = random_matrix_of_rank(random, rows, cols, rank);
        const Eigen::VectorXd b = random_matrix(random, rows, 1);
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> expected(rows, cols);
        expected.setThreshold(1e-10);
        expected.compute(a);
        const Eigen::VectorXd x = expected.solve(b);
        for (const double scale : scales) {
          const auto solution = internal::minimum_norm_solution(scale * a, b, 1e-10);
          ASSERT_EQ(solution.rank, rank) << rows << " x " << cols;
          ASSERT_LT((scale * solution.x - x).norm(), 1e-11) << rows << " x " << cols;
        }
      }
    }
  }
}

TEST(MinimumNorm, FindsTheRankToRounding) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const int rows = random.integer(2, 6), cols = random.integer(2, 12);
    Eigen::MatrixXd a = random_matrix(random, rows, cols);
    a.row(1) = -3 * a.row(0);
    const Eigen::Index rank = internal::minimum_norm_solution(a, Eigen::VectorXd::Ones(rows)).rank;
    ASSERT_EQ(rank, std::min(rows - 1, cols)) << rows << " x " << cols;
  }
}

TEST(MinimumNorm, OfNoColumnsIsEmpty) {
  const auto solution =
      internal::minimum_norm_solution(Eigen::MatrixXd(6, 0), Eigen::VectorXd::Ones(6));
  EXPECT_EQ(solution.x.size(), 0);
  EXPECT_EQ(solution.rank, 0);
  EXPECT_EQ(internal::pseudo_inverse(Eigen::MatrixXd(6, 0)).size(), 0);
}

TEST(PseudoInverse, IsThatOfACompleteOrthogonalDecomposition) {
  testing::Random random;
  for (int rows = 1; rows <= 6; ++rows) {
    for (int cols = 1; cols <= 12; ++cols) {
      const Eigen::MatrixXd a = random_matrix_of_rank(random, rows, cols, std::min(rows, cols));
      const Eigen::MatrixXd expected = a.completeOrthogonalDecomposition().pseudoInverse();
      for (const double scale : scales) {
        const Eigen::MatrixXd inverse = scale * internal::pseudo_inverse(scale * a);
        ASSERT_LT((inverse - expected).norm(), 1e-11) << rows << " x " << cols;
      }
    }
  }
  EXPECT_TRUE(internal::pseudo_inverse(Eigen::MatrixXd::Zero(3, 4)).isZero(0));
}

}  // namespace
}  // namespace beeline
