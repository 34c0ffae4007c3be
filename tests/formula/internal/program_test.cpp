#include <cmath>
#include <gtest/gtest.h>
#include <map>

#include <beeline/formula/internal/program_chain.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>
#include <tests/typical_arms.h>

namespace beeline::internal {
namespace {

/// The values of all nodes, for values of the variables.
std::vector<double> values_of(const Program& program,
                              const std::map<std::string, double>& variables) {
  std::vector<double> values;
  const auto of = [&values](int id) { return values[static_cast<std::size_t>(id)]; };
  for (const Program::Node& node : program.nodes()) {
    double value = node.number;
    switch (node.operation) {
      case Program::Operation::number:
        break;
      case Program::Operation::variable:
        value = variables.at(node.name);
        break;
      case Program::Operation::cosine:
        value = std::cos(of(node.a));
        break;
      case Program::Operation::sine:
        value = std::sin(of(node.a));
        break;
      case Program::Operation::negate:
        value = -of(node.a);
        break;
      case Program::Operation::add:
        value = of(node.a) + of(node.b);
        break;
      case Program::Operation::subtract:
        value = of(node.a) - of(node.b);
        break;
      case Program::Operation::multiply:
        value = of(node.a) * of(node.b);
        break;
    }
    values.push_back(value);
  }
  return values;
}

/// Evaluates entries of a chain's program at q and dq.
class Evaluation {
 public:
  Evaluation(ProgramChain& chain, const Configuration& q, const Configuration& dq) {
    std::map<std::string, double> variables = chain.constants();
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      variables["q[" + std::to_string(k) + "]"] = q[k];
      variables["dq[" + std::to_string(k) + "]"] = dq[k];
    }
    values_ = values_of(chain.program(), variables);
  }

  Eigen::MatrixXd matrix(const std::vector<Program::Id>& entries, Eigen::Index columns) const {
    Eigen::MatrixXd result(static_cast<Eigen::Index>(entries.size()) / columns, columns);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      const auto index = static_cast<Eigen::Index>(i);
      result(index / columns, index % columns) = values_[static_cast<std::size_t>(entries[i])];
    }
    return result;
  }

 private:
  std::vector<double> values_;
};

Configuration random_rates(testing::Random& random, int dof) {
  Configuration rates(dof);
  for (double& rate : rates) rate = random.uniform(-1, 1);
  return rates;
}

double largest(const Eigen::MatrixXd& matrix) { return matrix.cwiseAbs().maxCoeff(); }

/// Pose and Jacobians of the program equal the arm's.
void expect_arms_kinematics(const Arm& arm, testing::Random& random, int configurations,
                            double tolerance) {
  const SymbolicArm symbolic = symbolic_arm(arm);
  for (const bool numbers : {false, true}) {
    ProgramChain chain(symbolic, numbers);
    const std::vector<Program::Id> pose = chain.pose();
    for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
      const std::vector<Program::Id> columns = chain.jacobian(frame);
      for (int k = 0; k < configurations; ++k) {
        const Configuration q = random.configuration(arm);
        const Evaluation at(chain, q, Configuration::Zero(arm.dof()));
        EXPECT_LT(largest(at.matrix(pose, 4) - forward_kinematics(arm, q).matrix()), tolerance);
        EXPECT_LT(largest(at.matrix(columns, arm.dof()) - jacobian(arm, q, frame)), tolerance);
      }
    }
  }
}

TEST(Program, HasThePosesAndJacobiansOfBuiltInArms) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    expect_arms_kinematics(built_in(name), random, testing::cases(100), 1e-12);
  }
}

TEST(Program, HasThePosesAndJacobiansOfAnyArm) {
  testing::Random random;
  for (int k = 0; k < testing::cases(200); ++k) {
    expect_arms_kinematics(testing::random_arm(random, random.integer(1, 9), 4), random, 3, 1e-10);
  }
}

void expect_arms_derivatives(const Arm& arm, testing::Random& random, int configurations,
                             double tolerance) {
  const SymbolicArm symbolic = symbolic_arm(arm);
  ProgramChain chain(symbolic, false);
  for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
    const std::vector<Program::Id> entries = chain.derivative(frame);
    for (int k = 0; k < configurations; ++k) {
      const Configuration q = random.configuration(arm), rates = random_rates(random, arm.dof());
      const Eigen::MatrixXd found = Evaluation(chain, q, rates).matrix(entries, arm.dof());
      const Eigen::MatrixXd expected = jacobian_derivative(arm, q, rates, frame);
      EXPECT_LT(largest(found - expected), tolerance * std::max(1.0, largest(expected)));
    }
  }
}

TEST(Program, HasTheTimeDerivativesOfBuiltInArms) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    expect_arms_derivatives(built_in(name), random, testing::cases(1000), 1e-12);
  }
}

TEST(Program, HasTheTimeDerivativesOfAnyArm) {
  testing::Random random;
  for (int k = 0; k < testing::cases(200); ++k) {
    expect_arms_derivatives(testing::random_arm(random, random.integer(1, 9), 4), random, 3, 1e-10);
  }
}

TEST(Program, ComputesEachValueOnce) {
  Program program;
  const Program::Id x = program.variable("x"), y = program.variable("y");
  EXPECT_EQ(program.add(x, y), program.add(y, x));
  EXPECT_EQ(program.subtract(x, y), program.negate(program.subtract(y, x)));
  EXPECT_EQ(program.multiply(program.negate(x), y), program.negate(program.multiply(y, x)));
  EXPECT_EQ(program.subtract(program.add(x, y), y), x);
  EXPECT_EQ(program.subtract(x, program.add(x, y)), program.negate(y));
  EXPECT_EQ(program.multiply(x, program.number(0)), program.number(0));
  EXPECT_EQ(program.add(x, program.negate(x)), program.number(0));
  EXPECT_EQ(program.sine(program.negate(x), "s"), program.negate(program.sine(x, "s")));
}

}  // namespace
}  // namespace beeline::internal
