#include <beeline/certificate/verify.h>

#include <tests/certificate/two_joints.h>
#include <tests/reason.h>

namespace beeline {
namespace {

using namespace testing;

void expect_first(const Trajectory& motion, Fault kind, std::size_t sample) {
  const auto found = first_joint_fault(two_joints(), motion, {.start = true, .end = true});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, kind) << found->reason;
  EXPECT_EQ(found->sample, sample) << found->reason;
}

TEST(FirstJointFault, TellsEachKind) {
  const auto still = [] { return along(nothing, nothing, 10); };
  EXPECT_FALSE(first_joint_fault(two_joints(), still()));
  Trajectory motion = still();
  motion.positions[7][0] = 1.1;
  expect_first(motion, Fault::limits, 7);  // although the velocity before it exceeds its limit too
  motion = still();
  for (std::size_t k = 9; k < motion.size(); ++k) motion.positions[k][1] = 2 * pi;
  expect_first(motion, Fault::flip, 8);
  motion = along([](double t) { return 1.1 * t - 1; }, nothing, 1.5);
  expect_first(motion, Fault::velocity, 0);
  motion = along([](double t) { return 1.05 * t * t - 1; }, nothing, 0.4);
  expect_first(motion, Fault::acceleration, 0);
  motion = along([](double t) { return 1.05 * t * t * t - 1; }, nothing, 0.3);
  expect_first(motion, Fault::jerk, 0);
}

TEST(FirstJointFault, NamesAnExcessThatSixDigitsDoNotShow) {
  Trajectory motion = along(nothing, nothing, 10);
  motion.positions[7][0] = 1 + 2.5e-8;
  const auto found = first_joint_fault(two_joints(), motion);
  ASSERT_TRUE(found);
  EXPECT_EQ(testing::field<double>(found->reason, ReasonField::upper), 1.0);
  EXPECT_NEAR(testing::field<double>(found->reason, ReasonField::value).value_or(0), 1 + 2.5e-8,
              1e-12);
}

TEST(FirstJointFault, FindsMotionAtTheEnds) {
  Trajectory motion = along([](double t) { return 0.5 * t - 0.5; }, nothing, 1);
  const auto found = [&](MovingEnds moving) {
    return first_joint_fault(two_joints(), motion, moving);
  };
  ASSERT_TRUE(found({}));
  EXPECT_EQ(found({})->kind, Fault::moving);
  EXPECT_EQ(found({})->sample, 0u);
  ASSERT_TRUE(found({.start = true}));
  EXPECT_EQ(found({.start = true})->kind, Fault::moving);
  EXPECT_EQ(found({.start = true})->sample, motion.size() - 1);
  EXPECT_FALSE(found({.start = true, .end = true}));
}

// The joint moves at a constant velocity, stands still for a second, and moves on: divided
// differences over the long interval are small.
TEST(FirstJointFault, FindsAStandstillBetweenTwoSamples) {
  Trajectory motion = along([](double t) { return 0.5 * t - 0.5; }, nothing, 1);
  for (std::size_t k = 10; k < motion.size(); ++k) motion.times[k] += 1;
  motion.positions[10] = motion.positions[9];
  const auto found = first_joint_fault(two_joints(), motion, {.start = true, .end = true});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->kind == Fault::acceleration || found->kind == Fault::jerk) << found->reason;
  EXPECT_NEAR(double(found->sample), 8, 2) << found->reason;
}

TEST(FirstJointFault, LooksAtTheCubicBetweenSamplesWithVelocities) {
  Arm arm = two_joints();
  std::vector<Joint> joints = arm.joints();
  for (Joint& joint : joints) {
    joint.limits.velocity = joint.limits.acceleration = joint.limits.jerk = 1e9;
  }
  arm = Arm("two", joints);
  Trajectory motion = along(nothing, nothing, 10);
  motion.velocities.assign(motion.size(), Configuration::Zero(2));
  EXPECT_FALSE(first_joint_fault(arm, motion));
  const double h = motion.times[6] - motion.times[5];
  // The peak of a cubic from 0 at rest to 0 is 4/27 of the slope at its end times h.
  motion.velocities[6][0] = -6.5 / h;
  EXPECT_FALSE(first_joint_fault(arm, motion));
  motion.velocities[6][0] = -6.8 / h;
  const auto found = first_joint_fault(arm, motion);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Fault::limits) << found->reason;
  EXPECT_EQ(found->sample, 5u);
}

TEST(FirstJointFault, HoldsAssumedLimitsOfVelocityAndAcceleration) {
  std::vector<Joint> joints = two_joints().joints();
  joints[1].limits = {.lower = -20, .upper = 20, .velocity = 2};  // 8 rad/s^2, 80 rad/s^3
  joints[0].limits = {.lower = -1, .upper = 1};                   // 1 m/s
  const Arm arm("two", joints);
  const MovingEnds moving{.start = true, .end = true};
  const auto first = [&](const auto& slide, const auto& turning, double end) {
    return first_joint_fault(arm, along(slide, turning, end), moving);
  };
  EXPECT_FALSE(first(
      nothing, [](double t) { return 3.9 * t * t; }, 0.2));
  const auto found = first(
      nothing, [](double t) { return 4.1 * t * t; }, 0.2);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->kind, Fault::acceleration);
  EXPECT_EQ(testing::field<bool>(found->reason, ReasonField::assumed), true);
  EXPECT_EQ(testing::field<double>(found->reason, ReasonField::limit), 8.0);
  EXPECT_EQ(testing::field<std::string>(found->reason, ReasonField::quantity), "acceleration");
  const auto fast = first([](double t) { return 1.1 * t - 0.5; }, nothing, 0.5);
  ASSERT_TRUE(fast);
  EXPECT_EQ(fast->kind, Fault::velocity);
  // No jerk: minimum-time motions do not keep an assumed one.
  EXPECT_FALSE(first(
      nothing, [](double t) { return 50 * t * t * t; }, 0.02));
}

}  // namespace
}  // namespace beeline
