#include <cmath>
#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/trajectory/trajectory.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

TEST(WithLimits, ReplacesWhatIsSetAndKeepsTheRest) {
  const Arm panda = built_in("panda");
  const Arm arm = with_limits(
      panda, {{"joint2", {.velocity = 0.5, .jerk = Limits::none}}, {"joint4", {.upper = -0.1}}});
  for (int k = 0; k < panda.dof(); ++k) {
    const Limits &before = panda.limits(k), &after = arm.limits(k);
    EXPECT_EQ(after.lower, before.lower);
    EXPECT_EQ(after.upper, k == 3 ? -0.1 : before.upper);
    EXPECT_EQ(after.velocity, k == 1 ? 0.5 : before.velocity);
    EXPECT_EQ(after.acceleration, before.acceleration);
    EXPECT_EQ(after.jerk, k == 1 ? Limits::none : before.jerk);
    EXPECT_EQ(after.speed_scale, 1);
  }
  EXPECT_EQ(arm.name(), panda.name());
  EXPECT_EQ(arm.tool().matrix(), panda.tool().matrix());
}

TEST(WithLimits, MayWidenLimits) {
  const Arm arm = with_limits(built_in("ur5"), {{"joint1", {.lower = -20, .upper = 20}}});
  EXPECT_EQ(arm.limits(0).lower, -20);
  EXPECT_EQ(arm.limits(0).upper, 20);
}

TEST(WithLimits, TightensTheLeaderOfAMimicJoint) {
  Joint leader = built_in("rrr").joints()[0], follower = built_in("rrr").joints()[1];
  follower.mimic = Mimic{.leader = leader.name, .multiplier = -2};
  const Arm arm = with_limits({"pair", {leader, follower}},
                              {{follower.name, {.upper = 1, .velocity = 3, .acceleration = 4}}});
  EXPECT_EQ(arm.limits(0).lower, -0.5);
  EXPECT_EQ(arm.limits(0).velocity, 1.5);
  EXPECT_EQ(arm.limits(0).acceleration, 2);
}

TEST(WithLimits, RefusesUnknownJointsAndBadLimits) {
  const Arm arm = built_in("panda");
  EXPECT_REFUSED(with_limits(arm, {{"joint8", {}}}), "limits for an unknown joint \"joint8\"");
  EXPECT_REFUSED(with_limits(arm, {{"joint8", {}}}), "joint1, joint2, joint3");
  EXPECT_REFUSED(with_limits(arm, {{"joint1", {.lower = 3}}}), "exceeds upper limit 2.8973");
  EXPECT_REFUSED(with_limits(arm, {{"joint1", {.velocity = -1}}}), "velocity limit -1 is below");
  EXPECT_REFUSED(with_limits(arm, {{"joint1", {.jerk = std::nan("")}}}), "jerk limit nan");
  EXPECT_REFUSED(with_limits(arm, {{"joint1", {.upper = std::nan("")}}}), "NaN");
}

TEST(WithSpeedScale, MultipliesByThePowersOfTheScale) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const Arm unlimited = testing::random_arm(random, 5);
    std::map<std::string, LimitOverrides> limits;
    for (const Joint& joint : unlimited.joints()) {
      if (random.integer(0, 3) == 0) continue;  // remain unknown
      limits[joint.name] = {.velocity = random.uniform(0.1, 3),
                            .acceleration = random.uniform(1, 30),
                            .jerk = random.uniform(10, 3000)};
    }
    const Arm whole = with_limits(unlimited, limits);
    const double k = random.uniform(0.01, 1);
    const Arm slow = with_speed_scale(whole, k);
    for (int j = 0; j < whole.dof(); ++j) {
      const Limits &before = whole.limits(j), &after = slow.limits(j);
      EXPECT_EQ(after.lower, before.lower);
      EXPECT_EQ(after.upper, before.upper);
      EXPECT_DOUBLE_EQ(after.velocity, k * before.velocity);
      EXPECT_DOUBLE_EQ(after.acceleration, k * k * before.acceleration);
      EXPECT_DOUBLE_EQ(after.jerk, k * k * k * before.jerk);
      EXPECT_EQ(after.speed_scale, k);
      EXPECT_DOUBLE_EQ(velocity_limit_of(after), k * velocity_limit_of(before));
    }
  }
}

TEST(WithSpeedScale, TwoScalesMultiply) {
  const Arm arm = with_speed_scale(with_speed_scale(built_in("panda"), 0.5), 0.25);
  EXPECT_EQ(arm.limits(0).velocity, 2.175 / 8);
  EXPECT_EQ(arm.limits(0).speed_scale, 0.125);
  EXPECT_EQ(with_limits(arm, {{"joint1", {.velocity = 1}}}).limits(0).speed_scale, 0.125);
}

TEST(WithSpeedScale, RefusesScalesOutOfRange) {
  const Arm arm = built_in("panda");
  for (const double k : {0.0, -0.5, 1.01, 1e-7, std::nan(""), Limits::none}) {
    EXPECT_REFUSED(with_speed_scale(arm, k), "the speed scale must be from 1e-06 to 1, not");
  }
  EXPECT_REFUSED(with_speed_scale(arm, 2e-5), "the jerk limit of joint joint1 would be 6e-11");
}

}  // namespace
}  // namespace beeline
