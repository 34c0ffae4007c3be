#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/trajectory/limit_usage.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

/// One slide with limits 2 m/s, 10 m/s^2, 100 m/s^3.
Arm slide(double velocity = 2) {
  Joint joint;
  joint.name = "x";
  joint.screw = translation_screw(Vector3::UnitX());
  joint.limits = {.velocity = velocity, .acceleration = 10, .jerk = 100};
  return {"slide", {joint}};
}

Configuration one(double value) { return Configuration::Constant(1, value); }

TEST(LimitUsage, TakesSamplesAndTheirDifferences) {
  Trajectory trajectory{{"x"}, {0, 1, 3}, {one(0), one(1), one(-2)}, {}, {}};
  LimitUsage check = limit_usage(slide(), trajectory);
  EXPECT_NEAR(check.velocity.fraction, 0.75, 1e-12);  // 3 m in 2 s
  EXPECT_EQ(check.velocity.joint, "x");
  EXPECT_EQ(check.velocity.time, 1);
  EXPECT_EQ(check.acceleration.joint, "");
  EXPECT_EQ(check.jerk.fraction, 0);

  trajectory.velocities = {one(0), one(2.5), one(0)};
  check = limit_usage(slide(), trajectory);
  EXPECT_NEAR(check.velocity.fraction, 1.25, 1e-12);
  EXPECT_NEAR(check.acceleration.fraction, 0.25, 1e-12);  // 2.5 m/s in 1 s
  EXPECT_EQ(check.acceleration.time, 0);

  trajectory.accelerations = {one(0), one(-20), one(0)};
  check = limit_usage(slide(), trajectory);
  EXPECT_NEAR(check.acceleration.fraction, 2, 1e-12);
  EXPECT_NEAR(check.jerk.fraction, 0.2, 1e-12);
}

TEST(LimitUsage, HoldsAnUnknownVelocityLimitAtOneAndKnowsNoOther) {
  const Trajectory trajectory{{"x"}, {0, 1}, {one(0), one(0.5)}, {one(0), one(0)}, {}};
  EXPECT_NEAR(limit_usage(slide(Limits::none), trajectory).velocity.fraction, 0.5, 1e-12);
  const Arm rrr = built_in("rrr");
  const LimitUsage still = limit_usage(rrr, at_rest(rrr, middle_configuration(rrr)));
  EXPECT_EQ(still.velocity.fraction, 0);
  EXPECT_EQ(still.acceleration.joint, "");
}

TEST(LimitUsage, OfAMotionWithinItsLimitsPassesAtAnyRate) {
  // x = sin t at the limits of velocity 1, acceleration 1, jerk 1.
  Joint joint;
  joint.name = "x";
  joint.screw = translation_screw(Vector3::UnitX());
  joint.limits = {.velocity = 1, .acceleration = 1, .jerk = 1};
  const Arm arm("slide", {joint});
  testing::Random random;
  for (int i = 0; i < 50; ++i) {
    Trajectory trajectory{{"x"}, {}, {}, {}, {}};
    double t = random.uniform(0, 3);
    for (int k = 0; k < 200; ++k) {
      trajectory.times.push_back(t);
      trajectory.positions.push_back(one(std::sin(t)));
      trajectory.velocities.push_back(one(std::cos(t)));
      trajectory.accelerations.push_back(one(-std::sin(t)));
      t += std::pow(10, random.uniform(-9, 0));
    }
    const LimitUsage check = limit_usage(arm, trajectory);
    for (const LimitFraction* use : {&check.velocity, &check.acceleration, &check.jerk}) {
      ASSERT_LE(use->fraction, 1 + 1e-12);
      ASSERT_GT(use->fraction, 0.9);
    }
  }
}

TEST(LimitUsage, RefusesATrajectoryOfAnotherArm) {
  const Trajectory trajectory{{"y"}, {0, 1}, {one(0), one(0.5)}, {}, {}};
  EXPECT_REFUSED(limit_usage(slide(), trajectory), "lacks x");
}

}  // namespace
}  // namespace beeline
