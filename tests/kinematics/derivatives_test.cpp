#include <gtest/gtest.h>

#include <beeline/kinematics/internal/tool_motion.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

constexpr Frame derivative_frames[] = {Frame::base, Frame::tool, Frame::space};

/// Random arms of all joint types, some with mimic joints, and the built-in ones.
std::vector<Arm> arms_for_derivatives(testing::Random& random) {
  std::vector<Arm> arms;
  for (const std::string& name : built_in_names()) arms.push_back(built_in(name));
  for (int i = 0; i < 60; ++i) arms.push_back(testing::random_arm(random, 1 + i % 8, i % 4));
  return arms;
}

/// By central differences with one step of Richardson's extrapolation.
template <class Function>
Eigen::MatrixXd difference(const Function& f) {
  constexpr double h = 2e-4;
  const auto central = [&](double step) -> Eigen::MatrixXd {
    return (f(step) - f(-step)) / (2 * step);
  };
  return (4 * central(h / 2) - central(h)) / 3;
}

TEST(Hessian, IsTheDifferenceQuotientOfTheJacobian) {
  testing::Random random;
  for (const Arm& arm : arms_for_derivatives(random)) {
    const int n = arm.dof();
    for (int i = 0; i < 4; ++i) {
      const Configuration q = random.configuration(arm);
      for (const Frame frame : derivative_frames) {
        const Hessian derivatives = hessian(arm, q, frame);
        for (int k = 0; k < n; ++k) {
          const Eigen::MatrixXd numeric = difference([&](double step) -> Eigen::MatrixXd {
            return jacobian(arm, q + step * Configuration::Unit(n, k), frame);
          });
          const double size = 1 + numeric.norm();
          ASSERT_LT((derivatives.middleCols(k * n, n) - numeric).norm(), 1e-9 * size * size)
              << arm.name() << ", " << name(frame) << ", coordinate " << k;
        }
      }
    }
  }
}

TEST(JacobianDerivative, IsTheHessianTimesTheVelocities) {
  testing::Random random;
  for (const Arm& arm : arms_for_derivatives(random)) {
    const int n = arm.dof();
    for (int i = 0; i < 20; ++i) {
      const Configuration q = random.configuration(arm), dq = Configuration::Random(n);
      for (const Frame frame : derivative_frames) {
        const Hessian derivatives = hessian(arm, q, frame);
        Jacobian sum = Jacobian::Zero(6, n);
        for (int k = 0; k < n; ++k) sum += dq[k] * derivatives.middleCols(k * n, n);
        const Jacobian found = jacobian_derivative(arm, q, dq, frame);
        ASSERT_LT((found - sum).norm(), 1e-13 * (1 + sum.norm())) << arm.name() << name(frame);
      }
    }
  }
}

TEST(ToolAcceleration, IsTheDifferenceQuotientOfTheVelocity) {
  testing::Random random;
  for (const Arm& arm : arms_for_derivatives(random)) {
    const int n = arm.dof();
    const Configuration q = random.configuration(arm), dq = Configuration::Random(n),
                        ddq = Configuration::Random(n);
    for (const Frame frame : derivative_frames) {
      const Eigen::MatrixXd numeric = difference([&](double t) -> Eigen::MatrixXd {
        return jacobian(arm, q + t * dq + t * t / 2 * ddq, frame) * (dq + t * ddq);
      });
      const Twist found = tool_acceleration(arm, q, dq, ddq, frame);
      const double size = 1 + numeric.norm();
      ASSERT_LT((found - numeric).norm(), 1e-9 * size * size) << arm.name() << name(frame);
    }
    const Twist base = internal::tool_motion(arm, q, dq, ddq).acceleration;
    ASSERT_LT((tool_acceleration(arm, q, dq, ddq) - base).norm(), 1e-12 * (1 + base.norm()));
  }
}

TEST(Derivatives, RefuseWrongSizes) {
  const Arm arm = built_in("ur5");
  const Configuration q = Configuration::Zero(6), five = Configuration::Zero(5);
  Jacobian columns(6, 6), narrow(6, 5);
  EXPECT_REFUSED(jacobian_derivative(arm, five, q), "6");
  EXPECT_REFUSED(jacobian_derivative(arm, q, five), "6");
  EXPECT_REFUSED(jacobian_derivative(arm, q, q, narrow), "6 columns, not 5");
  EXPECT_REFUSED(hessian(arm, q, columns, columns), "36 columns, not 6");
  EXPECT_REFUSED(tool_acceleration(arm, q, q, five), "6");
  EXPECT_REFUSED(tool_acceleration(arm, q, q * std::nan(""), q), "nan");
}

}  // namespace
}  // namespace beeline
