#include <gtest/gtest.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>

#include <tests/random.h>

namespace beeline {
namespace {

/// A configuration whose joints are at least 0.3 inside their limits, where these allow it.
Configuration inside(testing::Random& random, const Arm& arm) {
  Configuration q(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    const double lower = std::max(limits.lower, -3.0) + 0.3;
    const double upper = std::min(limits.upper, 3.0) - 0.3;
    q[k] = lower < upper ? random.uniform(lower, upper) : (limits.lower + limits.upper) / 2;
  }
  return q;
}

/// A seed near a solution keeps an arm there: an answer on another branch moves the joints far.
TEST(NearSeed, KeepsRedundantArmsNear) {
  testing::Random random;
  for (const char* name : {"panda", "iiwa7", "gen3", "RRRR:0.4,0.3,0.2,0.1", "ur5e"}) {
    const Arm arm = read_arm(name);
    int far = 0;
    const int count = testing::cases(1500);
    for (int i = 0; i < count; ++i) {
      const Configuration q = inside(random, arm);
      Configuration seed = q;
      for (double& value : seed) value += random.uniform(-0.05, 0.05);
      const Pose pose = forward_kinematics(arm, q);
      const InverseResult found = inverse_kinematics(arm, pose, {.seed = seed});
      ASSERT_EQ(found.status, InverseStatus::solved) << name << ": " << q.transpose();
      const Configuration& solution = found.solutions.front();
      EXPECT_TRUE(forward_kinematics(arm, solution).isApprox(pose, 1e-9));
      far += (solution - seed).lpNorm<Eigen::Infinity>() > 1 ? 1 : 0;
    }
    // Next to a singularity a small motion of the tool may need a large one of the joints.
    EXPECT_LE(far, count / 100) << name;
  }
}

}  // namespace
}  // namespace beeline
