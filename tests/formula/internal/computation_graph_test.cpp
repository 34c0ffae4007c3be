#include <cmath>
#include <gtest/gtest.h>

#include <beeline/formula/internal/chain_graph.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>
#include <tests/typical_arms.h>

namespace beeline::internal {
namespace {

/// The values of all nodes at q and dq.
std::vector<double> values_of(const ComputationGraph& graph, const Configuration& q,
                              const Configuration& dq) {
  std::vector<double> values;
  const auto of = [&values](int id) { return values[static_cast<std::size_t>(id)]; };
  for (const ComputationGraph::Node& node : graph.nodes()) {
    double value = node.number;
    switch (node.operation) {
      case ComputationGraph::Operation::number:
        break;
      case ComputationGraph::Operation::constant:
        break;
      case ComputationGraph::Operation::coordinate:
        value = q[static_cast<Eigen::Index>(node.number)];
        break;
      case ComputationGraph::Operation::rate:
        value = dq[static_cast<Eigen::Index>(node.number)];
        break;
      case ComputationGraph::Operation::cosine:
        value = std::cos(of(node.a));
        break;
      case ComputationGraph::Operation::sine:
        value = std::sin(of(node.a));
        break;
      case ComputationGraph::Operation::negate:
        value = -of(node.a);
        break;
      case ComputationGraph::Operation::add:
        value = of(node.a) + of(node.b);
        break;
      case ComputationGraph::Operation::subtract:
        value = of(node.a) - of(node.b);
        break;
      case ComputationGraph::Operation::multiply:
        value = of(node.a) * of(node.b);
        break;
    }
    values.push_back(value);
  }
  return values;
}

/// Evaluates entries of a chain's graph at q and dq.
class Evaluation {
 public:
  Evaluation(ChainGraph& chain, const Configuration& q, const Configuration& dq) {
    values_ = values_of(chain.graph(), q, dq);
  }

  Eigen::MatrixXd matrix(const std::vector<ComputationGraph::Id>& entries,
                         Eigen::Index columns) const {
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

/// Pose and Jacobians of the graph equal the arm's.
void expect_arms_kinematics(const Arm& arm, testing::Random& random, int configurations,
                            double tolerance) {
  const SymbolicArm symbolic = symbolic_arm(arm);
  for (const bool numbers : {false, true}) {
    ChainGraph chain(symbolic, numbers);
    const std::vector<ComputationGraph::Id> pose = chain.pose();
    for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
      const std::vector<ComputationGraph::Id> columns = chain.jacobian(frame);
      for (int k = 0; k < configurations; ++k) {
        const Configuration q = random.configuration(arm);
        const Evaluation at(chain, q, Configuration::Zero(arm.dof()));
        EXPECT_LT(largest(at.matrix(pose, 4) - forward_kinematics(arm, q).matrix()), tolerance);
        EXPECT_LT(largest(at.matrix(columns, arm.dof()) - jacobian(arm, q, frame)), tolerance);
      }
    }
  }
}

TEST(ComputationGraph, HasThePosesAndJacobiansOfBuiltInArms) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    expect_arms_kinematics(built_in(name), random, testing::cases(100), 1e-12);
  }
}

TEST(ComputationGraph, HasThePosesAndJacobiansOfAnyArm) {
  testing::Random random;
  for (int k = 0; k < testing::cases(200); ++k) {
    expect_arms_kinematics(testing::random_arm(random, random.integer(1, 9), 4), random, 3, 1e-10);
  }
}

void expect_arms_derivatives(const Arm& arm, testing::Random& random, int configurations,
                             double tolerance) {
  const SymbolicArm symbolic = symbolic_arm(arm);
  ChainGraph chain(symbolic, false);
  for (const Frame frame : {Frame::base, Frame::tool, Frame::space}) {
    const std::vector<ComputationGraph::Id> entries = chain.derivative(frame);
    for (int k = 0; k < configurations; ++k) {
      const Configuration q = random.configuration(arm), rates = random_rates(random, arm.dof());
      const Eigen::MatrixXd found = Evaluation(chain, q, rates).matrix(entries, arm.dof());
      const Eigen::MatrixXd expected = jacobian_derivative(arm, q, rates, frame);
      EXPECT_LT(largest(found - expected), tolerance * std::max(1.0, largest(expected)));
    }
  }
}

TEST(ComputationGraph, HasTheTimeDerivativesOfBuiltInArms) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    expect_arms_derivatives(built_in(name), random, testing::cases(1000), 1e-12);
  }
}

TEST(ComputationGraph, HasTheTimeDerivativesOfAnyArm) {
  testing::Random random;
  for (int k = 0; k < testing::cases(200); ++k) {
    expect_arms_derivatives(testing::random_arm(random, random.integer(1, 9), 4), random, 3, 1e-10);
  }
}

TEST(ComputationGraph, ComputesEachValueOnce) {
  ComputationGraph graph;
  const ComputationGraph::Id x = graph.coordinate(0), y = graph.rate(0);
  EXPECT_EQ(graph.coordinate(0), x);
  EXPECT_NE(x, y);
  EXPECT_EQ(graph.add(x, y), graph.add(y, x));
  EXPECT_EQ(graph.subtract(x, y), graph.negate(graph.subtract(y, x)));
  EXPECT_EQ(graph.multiply(graph.negate(x), y), graph.negate(graph.multiply(y, x)));
  EXPECT_EQ(graph.subtract(graph.add(x, y), y), x);
  EXPECT_EQ(graph.subtract(x, graph.add(x, y)), graph.negate(y));
  EXPECT_EQ(graph.multiply(x, graph.number(0)), graph.number(0));
  EXPECT_EQ(graph.add(x, graph.negate(x)), graph.number(0));
  EXPECT_EQ(graph.sine(graph.negate(x), "s"), graph.negate(graph.sine(x, "s")));
}

}  // namespace
}  // namespace beeline::internal
