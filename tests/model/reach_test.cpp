#include <cmath>
#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/moving_base.h>
#include <beeline/pose/se3.h>

#include <tests/random_arm.h>

namespace beeline {
namespace {

void expect_never_left(const Arm& arm, testing::Random& random, int configurations) {
  const Arm::Reach& reach = arm.reach();
  ASSERT_TRUE(reach.centre.allFinite()) << arm.name();
  for (int i = 0; i < configurations; ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    ASSERT_LE((pose.translation() - reach.centre).norm(), reach.radius + 1e-12) << arm.name();
  }
}

TEST(Reach, ContainsTheToolsOfBuiltInArms) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    expect_never_left(built_in(name), random, 10000);
  }
}

TEST(Reach, ContainsTheToolsOfRandomArms) {
  testing::Random random;
  for (int i = 0; i < 400; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 8), i % 2 == 0 ? 0 : 3);
    ASSERT_TRUE(std::isfinite(arm.reach().radius)) << "every translation has limits here";
    expect_never_left(arm, random, 50);
  }
}

TEST(Reach, OfThePlanarArmIsTheSumOfItsLinksExactly) {
  const Arm arm = built_in("rrr");
  EXPECT_EQ(arm.reach().radius, 9);
  EXPECT_EQ(arm.reach().centre, Vector3::Zero());
  const Pose base = make_pose({1, 2, 3}, rotation({0, 0, 1}));
  const Arm moved("moved", arm.joints(), Pose::Identity(), base);
  EXPECT_NEAR(moved.reach().radius, 9, 1e-14);
  EXPECT_LT((moved.reach().centre - Vector3(1, 2, 3)).norm(), 1e-15);
}

TEST(Reach, IsTightForAStretchedChain) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    std::vector<Joint> joints;
    double sum = 0;
    for (int j = 0; j < 5; ++j) {
      Joint joint;
      joint.name = "j" + std::to_string(j);
      joint.screw = rotation_screw(Vector3::UnitZ());
      const double length = random.uniform(0, 1);
      joints.push_back(planar_link(joint, length));
      sum += length;
    }
    const Arm arm("chain", joints);
    ASSERT_NEAR(arm.reach().radius, sum, 3e-14);
    ASSERT_NEAR(forward_kinematics(arm, Configuration::Zero(5)).translation().norm(), sum, 3e-14);
  }
}

// A rail translates the ball of the arm on it: around the middle of its range, by half of it.
TEST(Reach, OfAnArmOnARailIsAroundItsMiddle) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm alone = testing::random_arm(random, random.integer(1, 6), i % 2 == 0 ? 0 : 3);
    const double lower = random.uniform(-3, 3), length = random.uniform(0, 4);
    const Vector3 axis = random.direction();
    const Arm railed = with_rail(alone, axis, {.lower = lower, .upper = lower + length});
    ASSERT_NEAR(railed.reach().radius, alone.reach().radius + length / 2, 1e-12);
    const Vector3 centre = alone.reach().centre + (lower + length / 2) * axis;
    ASSERT_LT((railed.reach().centre - centre).norm(), 1e-12);
    expect_never_left(railed, random, 50);
    const Arm based = with_mobile_base(railed, {.x = {.lower = -1, .upper = random.uniform(-1, 3)},
                                                .y = {.lower = 2, .upper = 3}});
    expect_never_left(based, random, 50);
  }
}

TEST(Reach, IsInfiniteOnlyForTranslationsWithoutLimits) {
  EXPECT_EQ(built_in("gantry").reach().radius, Limits::none);
  EXPECT_EQ(built_in("rp").reach().radius, Limits::none);
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    Joint joint = testing::random_joint(random, JointKind::revolute, "turning");
    joint.limits = {};
    const Arm turning("turning", {joint}, random.pose());
    ASSERT_TRUE(std::isfinite(turning.reach().radius))
        << "a rotation without limits stays on a circle";
    joint = testing::random_joint(random, JointKind::helical, "screwing");
    joint.limits = {};
    ASSERT_EQ(Arm("screwing", {joint}).reach().radius, Limits::none);
  }
}

TEST(Reach, WhatIsFarIsBeyondTenTimesTheRadius) {
  testing::Random random;
  for (int i = 0; i < testing::cases(200); ++i) {
    const Arm::Reach sphere{.centre = random.vector(3), .radius = random.uniform(0.1, 3)};
    const double distance = random.uniform(0, 20) * sphere.radius;
    EXPECT_EQ(far_from(sphere, distance), distance > 10 * sphere.radius);
    const Vector3 position = sphere.centre + distance * random.direction();
    EXPECT_EQ(
        rather_in_millimetres(sphere, position),
        far_from(sphere, distance) && (position / 1000 - sphere.centre).norm() <= sphere.radius);
  }
}

}  // namespace
}  // namespace beeline
