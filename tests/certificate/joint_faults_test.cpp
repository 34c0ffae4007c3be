#include <algorithm>
#include <cmath>

#include <beeline/certificate/verify.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/certificate/two_joints.h>
#include <tests/random.h>
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
  expect_first(motion, Fault::acceleration, 1);  // where the velocity jumps
  motion = along([](double t) { return 1.05 * t * t * t - 1; }, nothing, 0.3);
  expect_first(motion, Fault::jerk, 1);
}

TEST(FirstJointFault, VelocitiesShowInWhichDirectionAJointRotates) {
  Trajectory motion{.joint_names = {"slide", "turning"},
                    .times = {0, 4},
                    .positions = {Configuration{{0, 0}}, Configuration{{0, 4}}},
                    .velocities = {Configuration{{0, 0}}, Configuration{{0, 0}}},
                    .accelerations = {}};
  EXPECT_FALSE(first_joint_fault(two_joints(), motion));
  motion.velocities[0][1] = motion.velocities[1][1] = -0.1;
  expect_first(motion, Fault::flip, 0);
  motion.velocities[0][1] = motion.velocities[1][1] = 0;
  motion.times[1] = 0.39;  // 10.3 rad/s in the mean
  expect_first(motion, Fault::flip, 0);
  motion.times[1] = 4;
  motion.velocities.clear();
  expect_first(motion, Fault::flip, 0);
}

// The limits of the first joint are 1, 2 and 6: derivatives of t, t^2 and t^3.
TEST(FirstJointFault, AllowsAMillionthAboveALimitAndNoMore) {
  for (const int order : {1, 2, 3}) {
    for (const double excess : {-2e-6, 0.5e-6, 2e-6, 1e-4}) {
      const Trajectory motion =
          along([=](double t) { return (1 + excess) * std::pow(t, order) - 1; }, nothing, 0.3);
      const auto found = first_joint_fault(two_joints(), motion, {.start = true, .end = true});
      ASSERT_EQ(found.has_value(), excess > 1e-6) << order << " " << excess;
      if (!found) continue;
      constexpr Fault kinds[] = {Fault::velocity, Fault::acceleration, Fault::jerk};
      EXPECT_EQ(found->kind, kinds[order - 1]) << found->reason;
    }
  }
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

const FaultsOfKind* of_kind(const Verification& verification, Fault kind) {
  for (const FaultsOfKind& faults : verification.faults) {
    if (faults.kind == kind) return &faults;
  }
  return nullptr;
}

// Joints that are linear between samples, checked by hand: the kinds of fault, the first of each,
// and the largest.
TEST(VerifyWithoutPath, ListsEveryKindWithTheFirstAndTheWorst) {
  Random random;
  const Arm arm = two_joints();
  int seen = 0;
  for (int trial = 0; trial < cases(300); ++trial) {
    Trajectory motion = along(nothing, nothing, 20);
    for (Configuration& q : motion.positions) {
      q = Configuration{{random.uniform(-1.02, 1.02), random.uniform(-2.5, 2.5)}};
    }
    std::size_t outside = motion.size(), flips = motion.size(), fast = motion.size();
    double excess = 0, rotation = 0, fraction = 0;
    for (std::size_t k = 0; k < motion.size(); ++k) {
      const double beyond = std::abs(motion.positions[k][0]) - 1;
      if (beyond > 0) outside = std::min(outside, k);
      excess = std::max(excess, beyond);
      if (k + 1 == motion.size()) continue;
      const Configuration step = motion.positions[k + 1] - motion.positions[k];
      const double h = motion.times[k + 1] - motion.times[k];
      if (std::abs(step[1]) >= pi) flips = std::min(flips, k);
      rotation = std::max(rotation, std::abs(step[1]));
      const double used = std::max(std::abs(step[0]) / h / 1, std::abs(step[1]) / h / 10);
      if (used > 1) fast = std::min(fast, k);
      fraction = std::max(fraction, used);
    }
    const Verification checked = verify(arm, motion, VerifyOptions{.moving = {true, true}});
    ASSERT_FALSE(checked);  // the velocity jumps
    ASSERT_FALSE(checked.faults.empty());
    EXPECT_EQ(checked.faults.front().kind, checked.fault);
    const auto expect = [&](Fault kind, bool is_there, std::size_t first, double amount) {
      const FaultsOfKind* const faults = of_kind(checked, kind);
      ASSERT_EQ(faults != nullptr, is_there) << kind;
      if (faults == nullptr) return;
      ++seen;
      EXPECT_EQ(faults->sample, first) << kind;
      EXPECT_EQ(faults->time, motion.times[first]) << kind;
      EXPECT_NEAR(faults->amount, amount, 1e-9 * amount + 1e-12) << kind;
      EXPECT_EQ(testing::field<std::size_t>(faults->first, ReasonField::sample), first + 1);
      EXPECT_GE(testing::field<std::size_t>(faults->worst, ReasonField::sample).value_or(0),
                first + 1);
    };
    expect(Fault::limits, excess > 0, outside, excess);
    expect(Fault::flip, rotation >= pi, flips, rotation);
    expect(Fault::velocity, fraction > 1, fast, fraction);
  }
  EXPECT_GT(seen, cases(300));
}

TEST(VerifyWithoutPath, PassesAnArmAtRestAndBoundsNoDeviation) {
  const Verification checked = verify(two_joints(), along(nothing, nothing, 10));
  EXPECT_TRUE(checked);
  EXPECT_TRUE(checked.faults.empty());
  EXPECT_FALSE(std::isfinite(checked.deviation.bound.position));
  EXPECT_TRUE(checked.path.segments.empty());
  const Verification ended =
      verify(two_joints(), along(nothing, nothing, 10), VerifyOptions{.budget = {.max_work = 1}});
  EXPECT_FALSE(ended);
  EXPECT_EQ(ended.reason.code, ReasonCode::ended_before_check);
}

// The tool leaves the line at one sample and, by more, at a later one; a joint is too fast as well.
TEST(Verify, ListsFaultsOfThePathAndOfTheJoints) {
  const Arm rrr = built_in("rrr");
  const Configuration start{{0, 1.57, 0}};
  const PathMotion planned =
      move_in_lines(rrr, start, {Eigen::Translation3d(0.3, 0, 0) * forward_kinematics(rrr, start)});
  ASSERT_TRUE(planned);
  Trajectory motion = planned.trajectory;
  motion.velocities.clear();
  motion.accelerations.clear();
  const std::size_t first = motion.size() / 3, worst = 2 * motion.size() / 3;
  motion.positions[first][0] += 1e-3;
  motion.positions[worst][0] += 0.1;
  const Verification checked = verify(rrr, motion, {pose_at(planned.path, 1)}, {.tolerance = 1e-3});
  const FaultsOfKind* const deviation = of_kind(checked, Fault::deviation);
  ASSERT_NE(deviation, nullptr);
  EXPECT_LE(deviation->sample, first);
  EXPECT_EQ(testing::field<std::size_t>(deviation->worst, ReasonField::sample), worst + 1);
  EXPECT_GT(deviation->amount, 100);
  EXPECT_NE(of_kind(checked, Fault::velocity), nullptr);
}

}  // namespace
}  // namespace beeline
