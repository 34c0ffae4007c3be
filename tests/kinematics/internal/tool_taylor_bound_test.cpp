#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_taylor_bound.h>

#include <tests/random_arm.h>

namespace beeline::internal {
namespace {

std::vector<Polynomial> random_motion(testing::Random& random, const Arm& arm, double size) {
  std::vector<Polynomial> coordinates;
  for (const double q : random.configuration(arm)) {
    Polynomial& p = coordinates.emplace_back();
    p.c[0] = q;
    for (std::size_t k = 1; k < Polynomial::terms; ++k) p.c[k] = random.uniform(-size, size);
  }
  return coordinates;
}

/// The Taylor coefficients of a function at u, from n = 1 on: by fitting a polynomial of degree 8
/// to values nearby.
template <class Function>
std::array<double, 7> coefficient_norms(const Function& function, double u, double step) {
  constexpr int points = 9;
  Eigen::Matrix<double, points, points> powers;
  Eigen::Matrix<double, points, Eigen::Dynamic> values;
  for (int i = 0; i < points; ++i) {
    const double x = i - points / 2;
    const Eigen::VectorXd value = function(u + x * step);
    if (i == 0) values.resize(points, value.size());
    values.row(i) = value.transpose();
    for (int n = 0; n < points; ++n) powers(i, n) = std::pow(x, n);
  }
  const Eigen::MatrixXd coefficients = powers.inverse() * values;
  std::array<double, 7> norms{};
  for (int n = 0; n < 7; ++n) norms[n] = coefficients.row(n).norm() / std::pow(step, n);
  return norms;
}

TEST(ToolTaylorBound, BoundsTheDerivativesOfThePose) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 7), random.integer(0, 3));
    const std::vector<Polynomial> motion = random_motion(random, arm, random.uniform(0.1, 1));
    const ToolTaylorBound bound = tool_taylor_bound(arm, motion);
    const auto tool = [&](double u) {
      Configuration q(arm.dof());
      for (int k = 0; k < arm.dof(); ++k) q[k] = motion[static_cast<std::size_t>(k)](u);
      return forward_kinematics(arm, q);
    };
    const auto position = [&](double u) -> Eigen::VectorXd { return tool(u).translation(); };
    // A column of the rotation matrix: at most its operator norm.
    const auto axis = [&](double u) -> Eigen::VectorXd { return tool(u).linear().col(0); };
    const double u = random.uniform(0.05, 0.95);
    const auto p = coefficient_norms(position, u, 0.01), r = coefficient_norms(axis, u, 0.01);
    for (std::size_t n = 1; n < 5; ++n) {  // beyond, rounding of the values dominates
      ASSERT_LE(p[n], bound.position.c[n] * (1 + 1e-3) + 1e-4) << n;
      ASSERT_LE(r[n], bound.orientation.c[n] * (1 + 1e-3) + 1e-4) << n;
    }
  }
}

// One revolute joint at constant velocity w, a link of length l: |p^(n)| = l w^n, |R^(n)| = w^n.
TEST(ToolTaylorBound, IsExactForOneRevoluteJoint) {
  Joint joint;
  joint.name = "j";
  joint.screw = rotation_screw(Vector3::UnitZ());
  Pose tool = Pose::Identity();
  tool.translation() = Vector3(0.3, 0.4, 7);
  const Arm arm("one", {joint}, tool);
  constexpr double w = 0.7;
  const ToolTaylorBound bound = tool_taylor_bound(arm, std::vector{line_between(0.2, 0.2 + w)});
  double factorial = 1;
  for (std::size_t n = 1; n < 7; ++n) {
    factorial *= double(n);
    EXPECT_NEAR(bound.position.c[n], 0.5 * std::pow(w, double(n)) / factorial, 1e-12);
    EXPECT_NEAR(bound.orientation.c[n], std::pow(w, double(n)) / factorial, 1e-12);
  }
}

}  // namespace
}  // namespace beeline::internal
