#include <gtest/gtest.h>

#include <beeline/control/joint.h>
#include <beeline/control/player.h>
#include <beeline/control/servo.h>
#include <beeline/control/tracker.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/timing/point_to_point.h>

#include <tests/allocations.h>
#include <tests/random.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

TEST(Servo, DoesNotAllocate) {
#if !BEELINE_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations cannot be counted here";
#endif
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    Servo servo(arm);
    Eigen::VectorXd v(arm.dof());
    for (int i = 0; i < 200; ++i) {
      Configuration q = random.configuration(arm);
      if (i % 4 == 0) q.setZero();  // singular
      Twist command;
      command << random.vector(), random.vector();
      const Pose goal = forward_kinematics(arm, random.configuration(arm));
      const long before = allocations;
      servo.step(q, command, v);
      servo.step_towards(q, goal, v);
      EXPECT_EQ(allocations, before) << name;
    }
  }
}

TEST(Tracker, DoesNotAllocate) {
#if !BEELINE_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations cannot be counted here";
#endif
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    Tracker tracker(arm, random.configuration(arm), {.command_period = 2e-3});
    for (int i = 0; i < 200; ++i) {
      Pose goal = forward_kinematics(arm, random.configuration(arm));
      if (i % 4 == 0) goal.translation() *= 3;  // beyond reach
      const long before = allocations;
      for (int k = 0; k < 5; ++k) tracker.step(goal);
      EXPECT_EQ(allocations, before) << name;
    }
  }
}

TEST(Pid, DoesNotAllocate) {
#if !BEELINE_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations cannot be counted here";
#endif
  testing::Random random;
  const Arm arm = built_in("panda");
  Pid pid({0.3, 0.02, 0.1}, middle_configuration(arm));
  Configuration q = random.configuration(arm);
  const long before = allocations;
  for (int i = 0; i < 100; ++i) q += pid.step(q);
  EXPECT_EQ(allocations, before);
}

TEST(Player, DoesNotAllocate) {
#if !BEELINE_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations cannot be counted here";
#endif
  const Arm arm = built_in("panda");
  const Configuration middle = middle_configuration(arm);
  const PointToPoint motion = point_to_point(arm, middle, middle + Configuration::Constant(7, 0.3));
  Player player(arm, sampled(arm, motion, 100), middle - Configuration::Constant(7, 0.1));
  Configuration q = middle;
  const long before = allocations;
  for (int i = 0; i < 3000; ++i) {
    player.set_speed(i % 500 < 250 ? 1 : 0.2);
    q = player.step().q;
    player.measured(q);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE(player.done());
}

}  // namespace
}  // namespace beeline
