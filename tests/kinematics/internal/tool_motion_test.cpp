#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_motion.h>
#include <beeline/kinematics/jacobian.h>

#include <tests/random_arm.h>

namespace beeline::internal {
namespace {

Configuration random_rates(testing::Random& random, const Arm& arm) {
  Configuration rates(arm.dof());
  for (double& rate : rates) rate = random.uniform(-1, 1);
  return rates;
}

// The velocity equals J dq; the acceleration is its finite difference along the motion
// q + t dq + t^2 / 2 ddq, whose velocity at t is dq + t ddq.
TEST(ToolMotion, IsTheDerivativeOfThePose) {
  testing::Random random;
  constexpr double t = 1e-5;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 8), random.integer(0, 3));
    const Configuration q = random.configuration(arm);
    const Configuration dq = random_rates(random, arm), ddq = random_rates(random, arm);
    const PoseMotion tool = tool_motion(arm, q, dq, ddq);
    const auto velocity_at = [&](double time) -> Twist {
      const Configuration there = q + time * dq + 0.5 * time * time * ddq;
      return jacobian(arm, there) * (dq + time * ddq);
    };
    const double scale = 1 + tool.velocity.norm() + tool.acceleration.norm();
    ASSERT_TRUE(tool.pose.isApprox(forward_kinematics(arm, q), 1e-12));
    ASSERT_LT((tool.velocity - velocity_at(0)).norm(), 1e-11 * scale);
    const Twist difference = (velocity_at(t) - velocity_at(-t)) / (2 * t);
    ASSERT_LT((tool.acceleration - difference).norm(), 1e-6 * scale);
  }
}

}  // namespace
}  // namespace beeline::internal
