#include <Eigen/QR>
#include <gtest/gtest.h>

#include <beeline/math/damped_least_squares.h>

#include <tests/math/random_matrix.h>

namespace beeline {
namespace {

using testing::random_matrix;

TEST(DampedLeastSquares, IsTheLeastMotionThatMeetsTheError) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const int rows = random.integer(1, 6);
    const Eigen::MatrixXd j = random_matrix(random, rows, rows + 3);
    const Eigen::VectorXd e = random_matrix(random, rows, 1);
    const Eigen::VectorXd step = internal::damped_least_squares(j, e, 1e-18);
    ASSERT_LT((j * step - e).norm(), 1e-8);
    const Eigen::MatrixXd pseudo = j.completeOrthogonalDecomposition().pseudoInverse();
    ASSERT_LT((step - pseudo * e).norm(), 1e-6 * (1 + step.norm()));
  }
  EXPECT_TRUE(
      internal::damped_least_squares(Eigen::MatrixXd::Zero(3, 4), Vector3::Ones(), 1e-6).isZero(0));
}

/// The gradient of |J x - e|^2 + damping |x|^2 is zero.
TEST(DampedLeastSquares, MinimisesTheDampedError) {
  testing::Random random;
  for (const double damping : {1e-3, 1.0, 100.0}) {
    for (int i = 0; i < 50; ++i) {
      const int rows = random.integer(1, 6);
      const Eigen::MatrixXd j = random_matrix(random, rows, 5);
      const Eigen::VectorXd e = random_matrix(random, rows, 1);
      const Eigen::VectorXd x = internal::damped_least_squares(j, e, damping);
      ASSERT_LT((j.transpose() * (j * x - e) + damping * x).norm(), 1e-10);
    }
  }
}

}  // namespace
}  // namespace beeline
