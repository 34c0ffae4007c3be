#include <gtest/gtest.h>

#include <beeline/formula/formula.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>

namespace beeline {
namespace {

double largest(const Eigen::MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

class BuiltInFormula : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Arms, BuiltInFormula, ::testing::ValuesIn(built_in_names()));

TEST_P(BuiltInFormula, ForwardKinematicsEqualsTheArms) {
  const Arm arm = built_in(GetParam());
  const SymbolicArm symbolic = symbolic_arm(arm);
  const ExpressionMatrix tool = tool_formula(symbolic);
  testing::Random random;
  for (int k = 0; k < testing::cases(1000); ++k) {
    const Configuration q = random.configuration(arm);
    const std::vector<double> values = symbol_values(symbolic, q);
    EXPECT_LT(largest(tool.value(values) - forward_kinematics(arm, q).matrix()), 1e-12);
  }
}

TEST_P(BuiltInFormula, LinkTransformsEqualTheArms) {
  const Arm arm = built_in(GetParam());
  const SymbolicArm symbolic = symbolic_arm(arm);
  testing::Random random;
  for (std::size_t i = 1; i <= symbolic.links(); ++i) {
    const ExpressionMatrix in_base = link_formula(symbolic, i, 0);
    const ExpressionMatrix in_link_before = link_formula(symbolic, i, i - 1);
    for (int k = 0; k < testing::cases(100); ++k) {
      const Configuration q = random.configuration(arm);
      const std::vector<double> values = symbol_values(symbolic, q);
      const std::vector<Pose> links = link_poses(arm, q);
      const Eigen::Matrix4d base_T_link = (links[0].inverse() * links[i]).matrix();
      EXPECT_LT(largest(in_base.value(values) - base_T_link), 1e-12);
      const Eigen::Matrix4d before_T_link = (links[i - 1].inverse() * links[i]).matrix();
      EXPECT_LT(largest(in_link_before.value(values) - before_T_link), 1e-12);
    }
  }
}

TEST_P(BuiltInFormula, JacobiansEqualTheArms) {
  const Arm arm = built_in(GetParam());
  const SymbolicArm symbolic = symbolic_arm(arm);
  testing::Random random;
  for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
    const ExpressionMatrix formula = jacobian_formula(symbolic, frame);
    for (int k = 0; k < testing::cases(1000); ++k) {
      const Configuration q = random.configuration(arm);
      const Eigen::MatrixXd numbers = formula.value(symbol_values(symbolic, q));
      EXPECT_LT(largest(numbers - jacobian(arm, q, frame)), 1e-12) << name(frame);
    }
  }
}

/// The derivative by central differences, whose error is about 1e-10.
Eigen::MatrixXd difference(const Arm& arm, const Configuration& q, const Configuration& rates,
                           Frame frame) {
  constexpr double h = 1e-5;
  const Configuration after = q + h * rates, before = q - h * rates;
  return (jacobian(arm, after, frame) - jacobian(arm, before, frame)) / (2 * h);
}

TEST_P(BuiltInFormula, TimeDerivativesEqualDifferences) {
  const Arm arm = built_in(GetParam());
  const SymbolicArm symbolic = symbolic_arm(arm);
  testing::Random random;
  for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
    const ExpressionMatrix formula = time_derivative(symbolic, jacobian_formula(symbolic, frame));
    for (int k = 0; k < testing::cases(20); ++k) {
      const Configuration q = random.configuration(arm);
      Configuration rates(arm.dof());
      for (double& rate : rates) rate = random.uniform(-1, 1);
      const Eigen::MatrixXd numbers = formula.value(symbol_values(symbolic, q, rates));
      EXPECT_LT(largest(numbers - difference(arm, q, rates, frame)), 1e-8) << name(frame);
    }
  }
}

}  // namespace
}  // namespace beeline
