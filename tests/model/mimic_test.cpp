#include <gtest/gtest.h>
#include <limits>

#include <beeline/kinematics/forward.h>
#include <beeline/model/arm.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

Joint turning_joint(const std::string& name, Limits limits = {}) {
  Joint joint;
  joint.name = name;
  joint.screw = rotation_screw(Vector3::UnitZ());
  joint.limits = limits;
  return joint;
}

Joint follower(const std::string& name, const Mimic& mimic, Limits limits = {}) {
  Joint joint = turning_joint(name, limits);
  joint.mimic = mimic;
  return joint;
}

TEST(Mimic, ChainsMultiplyTheirRatiosAndCarryTheirShiftsInAnyOrder) {
  // c = 2 b + 1 and b = -3 a + 0.5, so c = -6 a + 2; c comes first, its leader's leader last.
  const Arm arm("arm", {follower("c", {"b", 2, 1}), turning_joint("free"),
                        follower("b", {"a", -3, 0.5}), turning_joint("a")});
  EXPECT_EQ(arm.dof(), 2);
  EXPECT_EQ(arm.joint_names(), (std::vector<std::string>{"free", "a"}));
  const Arm::JointCoupling& c = arm.couplings()[0];
  EXPECT_EQ(c.coordinate, 1);
  EXPECT_EQ(c.ratio, -6);
  EXPECT_EQ(c.shift, 2);
  EXPECT_EQ(arm.couplings()[1].coordinate, 0);
  EXPECT_EQ(arm.couplings()[2].ratio, -3);
  EXPECT_EQ(arm.couplings()[2].shift, 0.5);
  EXPECT_EQ(arm.couplings()[3].ratio, 1);
  EXPECT_EQ(arm.couplings()[3].shift, 0);
}

TEST(Mimic, MovesAsTheSameArmWithoutMimicMovesAtTheFollowersValues) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Arm arm = testing::random_arm(random, 8, 2);
    std::vector<Joint> independent = arm.joints();
    for (Joint& joint : independent) joint.mimic.reset();
    const Arm plain("plain", independent, arm.tool(), arm.base());
    const Configuration q = random.configuration(arm);
    // Each follower's value straight from its definition; leaders always come first here.
    std::vector<double> value(8);
    for (std::size_t j = 0, k = 0; j < 8; ++j) {
      const auto& mimic = arm.joints()[j].mimic;
      const std::size_t leader = mimic ? std::stoul(mimic->leader.substr(1)) : 0;
      value[j] = mimic ? mimic->multiplier * value[leader] + mimic->offset
                       : q[static_cast<Eigen::Index>(k++)];
    }
    const Pose expected = forward_kinematics(plain, Eigen::Map<Configuration>(value.data(), 8));
    ASSERT_LT((forward_kinematics(arm, q).matrix() - expected.matrix()).norm(), 1e-12);
  }
}

TEST(Mimic, LimitsOfLeadersAreTightenedToThoseOfFollowers) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const double ratio = random.uniform(-3, 3), shift = random.uniform(-5, 5);
    const Limits mine{-random.uniform(0.5, 2), random.uniform(0.5, 2), 1, 2, 3};
    const double kept = ratio * random.uniform(mine.lower, mine.upper) + shift;  // by both
    Limits its{kept - random.uniform(0.01, 2), kept + random.uniform(0.01, 2), 1.5, 1.5, 1.5};
    if (i % 3 == 0) its.lower = -Limits::none;
    const Arm arm("arm", {turning_joint("a", mine), follower("b", {"a", ratio, shift}, its)});
    const Limits& both = arm.limits(0);
    for (const double q : {both.lower, both.upper}) {
      ASSERT_GE(q, mine.lower);
      ASSERT_LE(q, mine.upper);
      ASSERT_GE(ratio * q + shift, its.lower - 1e-14);
      ASSERT_LE(ratio * q + shift, its.upper + 1e-14);
      const bool own = q == mine.lower || q == mine.upper;
      const double value = ratio * q + shift;
      ASSERT_TRUE(own || std::min(std::abs(value - its.lower), std::abs(value - its.upper)) < 1e-14)
          << "not tighter than necessary";
    }
    ASSERT_EQ(both.velocity, std::min(1.0, 1.5 / std::abs(ratio)));
    ASSERT_EQ(both.acceleration, std::min(2.0, 1.5 / std::abs(ratio)));
    ASSERT_EQ(both.jerk, std::min(3.0, 1.5 / std::abs(ratio)));
  }
}

TEST(Mimic, WithIncompatibleLimitsIsRefused) {
  const Limits narrow{.lower = 1, .upper = 2};
  EXPECT_REFUSED(Arm("arm", {turning_joint("a", narrow), follower("b", {"a", 1, 5}, narrow)}),
                 "mimic joint b with its leader: lower limit");
  EXPECT_REFUSED(Arm("arm", {turning_joint("a"), follower("b", {"a", 0, 5}, narrow)}),
                 "mimic joint b is fixed at 5, outside its limits 1 to 2");
  EXPECT_NO_THROW(Arm("arm", {turning_joint("a"), follower("b", {"a", 0, 1.5}, narrow)}));
}

TEST(Mimic, WithoutALeaderOrInACircleIsRefusedNamingTheCulprit) {
  EXPECT_REFUSED(Arm("arm", {turning_joint("elbow"), follower("b", {"elbw"})}),
                 "joint b mimics an unknown joint \"elbw\"; did you mean \"elbow\"?");
  EXPECT_REFUSED(Arm("arm", {turning_joint("a"), follower("b", {"b"})}), "joint b mimics itself");
  EXPECT_REFUSED(Arm("arm", {turning_joint("a"), follower("b", {"c"}), follower("c", {"b"})}),
                 "joint b mimics itself through its leaders");
  EXPECT_REFUSED(Arm("arm", {follower("a", {"b"}), follower("b", {"c"}), follower("c", {"b"})}),
                 "through its leaders");
}

TEST(Mimic, WithNumbersOutOfRangeIsRefusedAlsoWhenTheyArise) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_REFUSED(Arm("arm", {turning_joint("a"), follower("b", {"a", nan, 0})}),
                 "joint b: its mimic multiplier nan or offset nan is outside");
  EXPECT_REFUSED(Arm("arm", {turning_joint("a"), follower("b", {"a", 1, -Limits::none})}),
                 "joint b: its mimic multiplier 1 or offset -inf is outside");
  EXPECT_REFUSED(
      Arm("arm", {turning_joint("a"), follower("b", {"a", 1e5, 0}), follower("c", {"b", 1e5, 0})}),
      "joint c: its mimic multiplier 1e+10 or offset 0 is outside -1e+06 to 1e+06");
}

TEST(Mimic, ALongChainOfLeadersIsResolved) {
  constexpr int count = 98;
  std::vector<Joint> joints;
  for (int i = 0; i < count; ++i) {
    joints.push_back(follower("j" + std::to_string(i), {"j" + std::to_string(i + 1), -1, 1}));
  }
  joints.push_back(turning_joint("j" + std::to_string(count)));
  const Arm arm("arm", joints);
  EXPECT_EQ(arm.dof(), 1);
  EXPECT_EQ(arm.couplings()[0].ratio, 1) << "an even number of sign changes";
  EXPECT_EQ(arm.couplings()[0].shift, 0);
  EXPECT_EQ(arm.couplings()[1].ratio, -1);
  EXPECT_EQ(arm.couplings()[1].shift, 1);
}

}  // namespace
}  // namespace beeline
