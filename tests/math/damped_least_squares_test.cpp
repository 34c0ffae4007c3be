#include <Eigen/QR>
#include <gtest/gtest.h>

#include <beeline/math/damped_least_squares.h>

#include <tests/random.h>

namespace beeline {
namespace {

TEST(DampedLeastSquares, IsTheLeastMotionThatMeetsTheError) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const Eigen::MatrixXd j = Eigen::MatrixXd::NullaryExpr(
        3, 6, [&](Eigen::Index, Eigen::Index) { return random.uniform(-1, 1); });
    const Eigen::VectorXd e = random.vector();
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
      const Eigen::MatrixXd j = Eigen::MatrixXd::NullaryExpr(
          3, 5, [&](Eigen::Index, Eigen::Index) { return random.uniform(-1, 1); });
      const Eigen::VectorXd e = random.vector();
      const Eigen::VectorXd x = internal::damped_least_squares(j, e, damping);
      ASSERT_LT((j.transpose() * (j * x - e) + damping * x).norm(), 1e-12);
    }
  }
}

}  // namespace
}  // namespace beeline
