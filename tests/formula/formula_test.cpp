#include <gtest/gtest.h>

#include <beeline/formula/document.h>
#include <beeline/formula/formula.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

double largest(const Eigen::MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

class BuiltInFormula : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Arms, BuiltInFormula, ::testing::ValuesIn(testing::typical_arms));

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

TEST_P(BuiltInFormula, DeterminantEqualsTheJacobians) {
  const Arm arm = built_in(GetParam());
  const SymbolicArm symbolic = symbolic_arm(arm);
  testing::Random random;
  for (const char* mask : {"111111", "110001", "111000", "110000", "111001"}) {
    const Task task = task_named(mask);
    if (task.size() != arm.dof()) continue;
    const DeterminantFormula formula = determinant_formula(symbolic, task);
    for (int k = 0; k < testing::cases(1000); ++k) {
      const Configuration q = random.configuration(arm);
      const double determinant = task_jacobian(arm, q, task).determinant();
      EXPECT_NEAR(formula.value(symbol_values(symbolic, q)), determinant, 1e-12);
    }
  }
}

TEST_P(BuiltInFormula, TimeDerivativesEqualTheArms) {
  const Arm arm = built_in(GetParam());
  const SymbolicArm symbolic = symbolic_arm(arm);
  testing::Random random;
  for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
    const ExpressionMatrix formula = time_derivative(symbolic, jacobian_formula(symbolic, frame));
    for (int k = 0; k < testing::cases(1000); ++k) {
      const Configuration q = random.configuration(arm);
      Configuration rates(arm.dof());
      for (double& rate : rates) rate = random.uniform(-1, 1);
      const Eigen::MatrixXd numbers = formula.value(symbol_values(symbolic, q, rates));
      EXPECT_LT(largest(numbers - jacobian_derivative(arm, q, rates, frame)), 1e-12) << name(frame);
    }
  }
}

/// All tasks of three rows, for arms that are not planar.
TEST(AnyFormula, HasTheDeterminantsOfTasks) {
  testing::Random random;
  const Arm puma = built_in("puma560");
  const Arm arm{"puma", {puma.joints().begin(), puma.joints().begin() + 3}, random.pose()};
  const SymbolicArm symbolic = symbolic_arm(arm);
  for (const char* mask : {"111000", "110001", "000111", "101010", "110001:tool", "111000:tool"}) {
    const Task task = task_named(mask);
    const DeterminantFormula formula = determinant_formula(symbolic, task);
    for (int k = 0; k < testing::cases(100); ++k) {
      const Configuration q = random.configuration(arm);
      const double determinant = task_jacobian(arm, q, task).determinant();
      EXPECT_NEAR(formula.value(symbol_values(symbolic, q)), determinant, 1e-12) << mask;
    }
  }
}

/// An arm of one or two joints with any offsets and axes, mimic joints and helical joints.
TEST(AnyFormula, EqualsTheArms) {
  testing::Random random;
  int compared = 0;
  for (int k = 0; k < testing::cases(100); ++k) {
    const Arm arm = testing::random_arm(random, random.integer(1, 2), 3);
    const SymbolicArm symbolic = symbolic_arm(arm, {.max_symbols = 20000});
    const Configuration q = random.configuration(arm);
    const std::vector<double> values = symbol_values(symbolic, q);
    try {
      const Eigen::MatrixXd pose = tool_formula(symbolic).value(values);
      EXPECT_LT(largest(pose - forward_kinematics(arm, q).matrix()), 1e-11);
      for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
        const Eigen::MatrixXd columns = jacobian_formula(symbolic, frame).value(values);
        EXPECT_LT(largest(columns - jacobian(arm, q, frame)), 1e-11) << name(frame);
      }
      ++compared;
    } catch (const Error&) {  // too large
    }
  }
  EXPECT_GT(compared, testing::cases(100) / 4);
}

TEST(FormulaCode, OfAnyMatrixIsOneFunction) {
  const SymbolicArm rrr = symbolic_arm(built_in("rrr"));
  const ExpressionMatrix columns = jacobian_formula(rrr);
  const GeneratedCode code = formula_code(rrr, columns, "columns", CodeLanguage::c);
  ASSERT_EQ(code.functions.size(), 1u);
  EXPECT_EQ(code.functions[0].name, "rrr_columns");
  EXPECT_EQ(code.functions[0].trigonometric, 6);
  EXPECT_NE(code.text.find("rrr_columns(const double q[3], double M[18])"), std::string::npos);
  const ExpressionMatrix rate = time_derivative(rrr, columns);
  EXPECT_NE(formula_code(rrr, rate, "rate", CodeLanguage::python).text.find("rrr_rate(q, dq):"),
            std::string::npos);
  const ExpressionMatrix one{1, 1, {columns(0, 0)}};
  EXPECT_NE(formula_code(rrr, one, "x", CodeLanguage::cpp).text.find("double rrr_x("),
            std::string::npos);
  for (const char* name : {"", "a b", "x;", "\u00e4"}) {
    EXPECT_THROW(formula_code(rrr, one, name, CodeLanguage::c), Error) << name;
  }
  EXPECT_THROW(formula_code(rrr, {}, "x", CodeLanguage::c), Error);
}

}  // namespace
}  // namespace beeline
