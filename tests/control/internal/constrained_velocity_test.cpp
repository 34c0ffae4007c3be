#include <gtest/gtest.h>

#include <beeline/control/internal/constrained_velocity.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

/// Random inequalities that 0 satisfies. No feasible point near the result is nearer to x0.
TEST(ConstrainedVelocity, IsTheNearestThatSatisfiesTheInequalities) {
  testing::Random random;
  const auto number = [&] { return random.uniform(-1, 1); };
  int bound = 0;
  for (int i = 0; i < testing::cases(1500); ++i) {
    const int n = random.integer(1, 8), rows = random.integer(0, 6);
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(n, n, number);
    const Eigen::MatrixXd h = root * root.transpose() + 1e-2 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd x0 = 2 * Eigen::VectorXd::NullaryExpr(n, number);
    const Eigen::VectorXd upper = Eigen::VectorXd::NullaryExpr(n, number).cwiseAbs();
    const Eigen::VectorXd lower = -Eigen::VectorXd::NullaryExpr(n, number).cwiseAbs();
    ConstrainedVelocity solver(n, rows);
    Eigen::MatrixXd given(n, rows);
    Eigen::VectorXd least(rows);
    for (int k = 0; k < rows; ++k) {
      given.col(k) = Eigen::VectorXd::NullaryExpr(n, number);
      least[k] = -0.5 * std::abs(number());
      solver.add(given.col(k), least[k]);
    }
    const Eigen::VectorXd x = solver.solve(h, x0, lower, upper);
    const auto violation = [&](const Eigen::VectorXd& at) {
      double largest = std::max((lower - at).maxCoeff(), (at - upper).maxCoeff());
      if (rows > 0) largest = std::max(largest, (least - given.transpose() * at).maxCoeff());
      return largest;
    };
    const auto cost = [&](const Eigen::VectorXd& at) { return (at - x0).dot(h * (at - x0)); };
    ASSERT_LT(violation(x), 1e-6) << i;
    if (solver.leading_row() >= 0) ++bound;
    for (int k = 0; k < 100; ++k) {
      const Eigen::VectorXd near =
          x + std::pow(10, random.uniform(-4, 0)) * Eigen::VectorXd::NullaryExpr(n, number);
      if (violation(near) > 0) continue;
      ASSERT_GT(cost(near), cost(x) - 1e-5) << i;
    }
  }
  EXPECT_GT(bound, 0);
}

}  // namespace
}  // namespace beeline::internal
