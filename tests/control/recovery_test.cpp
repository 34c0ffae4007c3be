#include <cmath>
#include <gtest/gtest.h>

#include <beeline/certificate/verify.h>
#include <beeline/control/joint.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::cases;

TEST(RecoveryOfJointMoves, EachJointFallsBackWithinItsLimits) {
  testing::Random random;
  for (const char* name : {"panda", "ur5", "puma560", "scara"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(120); ++i) {
      Configuration start = random.configuration(arm);
      const int k = random.integer(0, arm.dof() - 1);
      const bool above = random.integer(0, 1) == 0;
      const double amount = std::pow(10, random.uniform(-8, -1.01));
      start[k] = above ? arm.limits(k).upper + amount : arm.limits(k).lower - amount;
      const double excess = above ? start[k] - arm.limits(k).upper : arm.limits(k).lower - start[k];
      JointMoveOptions options{.recover = excess};
      if (random.integer(0, 1) == 0) options.synchronise = Synchronise::straight;
      const ControlledMotion motion = move_joints(arm, start, random.configuration(arm), options);
      ASSERT_TRUE(motion) << motion.reason;
      ASSERT_TRUE(motion.recovery);
      EXPECT_EQ(motion.recovery->joint, arm.joint_of(k).name);
      EXPECT_EQ(motion.recovery->excess, excess);
      double last = start[k];
      for (const Configuration& q : motion.trajectory.positions) {
        ASSERT_LE(above ? q[k] - last : last - q[k], 0);
        last = q[k];
      }
      const Verification proved = verify(arm, motion.trajectory, VerifyOptions{.recover = excess});
      EXPECT_TRUE(proved) << name << ": " << proved.reason;
      EXPECT_EQ(verify(arm, motion.trajectory).fault, Fault::limits);
      options.recover = excess / 2;
      EXPECT_REFUSED(move_joints(arm, start, middle_configuration(arm), options), "cannot start");
    }
  }
}

TEST(RecoveryOfJointMoves, IsAcceptedWithoutTheOptionUpToATenthOfARadian) {
  const Arm arm = built_in("panda");
  Configuration start = middle_configuration(arm);
  const Configuration goal = start;
  EXPECT_FALSE(move_joints(arm, start, goal).recovery);
  start[1] = arm.limits(1).upper + 0.09;
  const ControlledMotion motion = move_joints(arm, start, goal);
  ASSERT_TRUE(motion && motion.recovery);
  EXPECT_NEAR(motion.recovery->excess, 0.09, 1e-12);
  EXPECT_REFUSED(move_joints(arm, start, goal, {.recover = 0.0}), "cannot start");
  for (const double wrong : {-1e-9, 0.2, 1e300, Limits::none, std::nan("")}) {
    EXPECT_REFUSED(move_joints(arm, goal, goal, {.recover = wrong}), "recover must be from 0");
  }
}

}  // namespace
}  // namespace beeline
