#include <cmath>
#include <gtest/gtest.h>

#include <beeline/control/internal/bounded_least_squares.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

TEST(BoundedLeastSquares, SatisfiesTheOptimalityConditions) {
  testing::Random random;
  int at_bound = 0;
  for (int i = 0; i < testing::cases(5000); ++i) {
    const int n = random.integer(1, 9);
    Jacobian a(6, n);
    for (int k = 0; k < n; ++k) a.col(k) << random.vector(), random.vector();
    if (i % 3 == 0) a.row(random.integer(0, 5)).setZero();
    BoundedLeastSquares::Rows c;
    c << random.vector(3), random.vector(3);
    Eigen::VectorXd bias(n), lower(n), upper(n);
    for (int k = 0; k < n; ++k) {
      bias[k] = random.uniform(-0.5, 0.5);
      lower[k] = -random.uniform(0, 1) * random.integer(0, 3);  // zero at times
      upper[k] = random.uniform(0, 1) * random.integer(0, 3);
    }
    const double damping = std::pow(10, random.uniform(-6, 0));
    BoundedLeastSquares solver(n);
    const Eigen::VectorXd x = solver.solve(a, c, damping, bias, lower, upper);
    const Eigen::VectorXd descent = a.transpose() * (c - a * x) - damping * (x - bias);
    for (int k = 0; k < n; ++k) {
      ASSERT_GE(x[k], lower[k] - 1e-15);
      ASSERT_LE(x[k], upper[k] + 1e-15);
      if (x[k] < upper[k]) {
        ASSERT_LT(descent[k], 1e-8) << i;
      }
      if (x[k] > lower[k]) {
        ASSERT_GT(descent[k], -1e-8) << i;
      }
      if (x[k] == upper[k] || x[k] == lower[k]) ++at_bound;
    }
  }
  EXPECT_GT(at_bound, testing::cases(5000));
}

TEST(BoundedLeastSquares, IsTheDampedStepWithinWideBounds) {
  testing::Random random;
  for (int i = 0; i < 200; ++i) {
    const int n = random.integer(1, 8);
    Jacobian a(6, n);
    for (int k = 0; k < n; ++k) a.col(k) << random.vector(), random.vector();
    BoundedLeastSquares::Rows c;
    c << random.vector(), random.vector();
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n), far = zero.array() + 1e6;
    BoundedLeastSquares solver(n);
    const Eigen::VectorXd x = solver.solve(a, c, 0.01, zero, -far, far);
    const Eigen::MatrixXd normal = a.transpose() * a + 0.01 * Eigen::MatrixXd::Identity(n, n);
    EXPECT_LT((normal * x - a.transpose() * c).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace beeline::internal
