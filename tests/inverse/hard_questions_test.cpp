#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se3.h>

#include <tests/inverse/answer.h>
#include <tests/random_arm.h>
#include <tests/random_table.h>

// Each of these had a wrong result once.

namespace beeline {
namespace {

using std::numbers::pi;

using testing::expect_solved;

/// A copy with each joint within `width` of q.
Arm narrowed(const Arm& arm, const Configuration& q, double width) {
  std::vector<Joint> joints = arm.joints();
  for (std::size_t i = 0; i < joints.size(); ++i) {
    joints[i].limits.lower = q[static_cast<Eigen::Index>(i)] - width;
    joints[i].limits.upper = q[static_cast<Eigen::Index>(i)] + width;
  }
  return {arm.name(), joints, arm.tool(), arm.base()};
}

TEST(HardQuestions, NextToASingularWristNothingIsCalledComplete) {
  testing::Random random;
  int solved = 0, asked = 0;
  for (const double straight : {0.0, pi, -pi}) {
    for (double off = 1e-12; off < 1e-5; off *= 10) {
      for (int i = 0; i < 10; ++i, ++asked) {
        Configuration q(6);
        for (double& value : q) value = random.uniform(-1.5, 1.5);
        q[4] = straight + (straight > 0 ? -off : off);
        const Arm arm = narrowed(built_in("ur5"), q, 0.3);
        const InverseResult result = inverse_kinematics(arm, forward_kinematics(arm, q));
        if (result.status == InverseStatus::solved) ++solved;
        EXPECT_NE(result.reason.code, ReasonCode::all_solutions_outside_limits) << result.reason;
        EXPECT_NE(result.status, InverseStatus::unreachable) << result.reason;
      }
    }
  }
  EXPECT_GE(solved, asked * 95 / 100) << asked;
}

TEST(HardQuestions, SeedsFarAwayCostNoDigits) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  Eigen::MatrixXd column(6, 1);
  for (const double far : {1e2, 1e4, 1e6, 1e9, 1e17}) {
    const Configuration q = random.configuration(arm), seed = Configuration::Constant(6, far);
    const Pose pose = forward_kinematics(arm, q);
    const InverseResult result =
        inverse_kinematics(arm, pose, {.seed = seed, .ignore_limits = true});
    ASSERT_EQ(result.status, InverseStatus::solved) << far << result.reason;
    EXPECT_LE(result.residual, 1e-10);
    ASSERT_EQ(inverse_kinematics(arm, pose, seed, column, {.ignore_limits = true}), 1);
    const Deviation error =
        task_deviation(Task::spatial(), pose, forward_kinematics(arm, column.col(0)));
    EXPECT_LE(testing::largest(error), 1e-10) << far;
  }
}

TEST(HardQuestions, ATimeLimitMakesNothingUnreachable) {
  testing::Random random;
  std::vector<Joint> joints;
  for (int i = 0; i < 20; ++i) {
    joints.push_back(dh_joint({.a = 1}, DhConvention::standard));
    joints.back() = testing::named(joints.back(), "j" + std::to_string(i), -0.6, 0.6);
  }
  const Arm arm("snake", joints);
  constexpr int iterations = 2;  // too few for most poses
  int unsolved = 0;
  for (int i = 0; i < 50; ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    const InverseResult result = inverse_kinematics(
        arm, pose, {.max_iterations = iterations, .budget = {.time_limit = 1e-9}});
    // Two searches, of which each fills its eight lanes twice at most before it looks at the clock.
    EXPECT_LE(result.restarts, 2 * 15);
    EXPECT_LE(result.iterations, (2 * 16 + 1) * iterations);
    if (result.status == InverseStatus::solved) continue;
    ++unsolved;
    EXPECT_EQ(result.status, InverseStatus::time_limit) << result.reason;
    EXPECT_GT(result.residual, 1e-10);
  }
  EXPECT_GE(unsolved, 10);
}

TEST(HardQuestions, ResultsDoNotDependOnEarlierOnes) {
  testing::Random random;
  const Arm arm = testing::random_arm(random, 6, 0);
  const Pose nowhere = make_pose({100, 0, 0});
  inverse_kinematics(arm, nowhere);
  for (int i = 0; i < 50; ++i) {
    const Pose pose = forward_kinematics(arm, random.configuration(arm));
    const Arm fresh(arm.name(), arm.joints(), arm.tool(), arm.base());
    const InverseResult a = inverse_kinematics(arm, pose), b = inverse_kinematics(fresh, pose);
    ASSERT_EQ(a.status, b.status);
    ASSERT_EQ(a.solutions, b.solutions);
    ASSERT_EQ(a.method, b.method);
  }
}

TEST(HardQuestions, EveryTurnIsCheckedToo) {
  std::vector<Joint> joints;
  for (int i = 0; i < 2; ++i) {
    joints.push_back(dh_joint({.a = 1}, DhConvention::standard));
    joints.back() = testing::named(joints.back(), "j" + std::to_string(i), -500, 500);
  }
  const Arm arm("turns", joints);
  const Configuration q{{0.3, 0.9}};
  const InverseResult result = inverse_kinematics(
      arm, forward_kinematics(arm, q), {.task = Task::position(), .all = true, .every_turn = true});
  expect_solved(arm, forward_kinematics(arm, q), Task::position(), result, 1e-10);
  EXPECT_GT(result.solutions.size(), 40'000U);
}

TEST(HardQuestions, AProofOfInfeasibilityIsReportedForAnyTask) {
  const Arm scara = built_in("scara");
  Pose tilted = forward_kinematics(scara, Configuration::Zero(4));
  tilted.linear() = tilted.linear() * so3_exp(Vector3(0.5, 0, 0));
  const InverseResult result = inverse_kinematics(scara, tilted, {.task = task_named("000111")});
  EXPECT_EQ(result.status, InverseStatus::orientation_unreachable) << result.reason;
  EXPECT_NEAR(result.residual, 0.5, 1e-9);
}

TEST(HardQuestions, HelicalJointsWithoutLimitsRotateByManyTurns) {
  Joint turn = dh_joint({.a = 1}, DhConvention::standard), screw;
  screw.screw = rotation_screw(Vector3::UnitZ(), Vector3::Zero(), 0.1);
  screw.offset = make_pose({0.3, 0, 0});
  const Arm arm("screw",
                {testing::named(turn, "a"), testing::named(screw, "b"), testing::named(turn, "c")});
  testing::Random random;
  for (int i = 0; i < 20; ++i) {
    const Configuration q{{random.uniform(-3, 3), random.uniform(-20, 20), random.uniform(-3, 3)}};
    const Pose pose = forward_kinematics(arm, q);
    expect_solved(arm, pose, Task::spatial(), inverse_kinematics(arm, pose));
  }
}

// A joint that stands still in self-motions has the value that the pose determines: no value of a
// grid solves.
TEST(HardQuestions, SevenJointsWhoseEndsStandStillInSelfMotions) {
  testing::Random random;
  constexpr double right = pi / 2;
  const std::vector<DhRow> ur{
      {.alpha = right, .d = 0.3},  {.a = 0.4}, {.a = 0.35}, {.alpha = right, .d = 0.1},
      {.alpha = -right, .d = 0.1}, {.d = 0.08}};
  std::vector<DhRow> parallel = ur, turntable = ur;
  parallel.insert(parallel.begin() + 3, {.a = 0.3});
  turntable.insert(turntable.begin(), {.d = 0.2});
  for (const std::vector<DhRow>& rows : {parallel, turntable}) {
    const Arm arm = testing::arm_of_rows(rows, DhConvention::standard);
    for (const bool limited : {false, true}) {
      const int count = testing::cases(40);
      for (int i = 0; i < count; ++i) {
        Configuration q(7);
        for (double& value : q) value = random.uniform(-2, 2);
        const Arm asked =
            limited ? narrowed(arm, Configuration::Zero(7), random.uniform(2.1, 3)) : arm;
        const Pose pose = forward_kinematics(arm, q);
        expect_solved(asked, pose, Task::spatial(), inverse_kinematics(asked, pose));
        Eigen::MatrixXd column(7, 1);
        EXPECT_EQ(inverse_kinematics(asked, pose, Configuration::Zero(7), column), 1);
      }
    }
  }
}

TEST(HardQuestions, NoPoseOfAnArmOfRightAnglesIsCalledUnreachable) {
  testing::Random random;
  int solved = 0;
  const int count = testing::cases(150);
  for (int i = 0; i < count; ++i) {
    std::vector<DhRow> rows = testing::random_rows(random, 7, random.integer(0, 1) == 0);
    for (DhRow& row : rows) {
      if (random.integer(0, 1) == 0) row.a = 0;
      if (random.integer(0, 1) == 0) row.alpha = random.integer(-1, 1) * pi / 2;
    }
    const Arm arm = testing::arm_of_rows(rows, DhConvention::standard);
    Configuration q(7);
    for (double& value : q) value = random.uniform(-2, 2);
    const InverseResult result = testing::explained_inverse(arm, forward_kinematics(arm, q));
    EXPECT_TRUE(result || result.status == InverseStatus::not_found)
        << "case " << i << ": " << result.reason;
    solved += result ? 1 : 0;
  }
  EXPECT_GE(solved, count * 95 / 100);
}

// Rounding may put the equivalent of a value at its limit beyond the limit by the last digit.
TEST(HardQuestions, AValueAtALimitOfWholeTurnsIsNotMovedByATurn) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < testing::cases(200); ++i) {
    Configuration q = random.configuration(arm);
    const int k = random.integer(0, 5);
    const bool upper = random.integer(0, 1) == 0;
    q[k] = upper ? arm.limits(k).upper : arm.limits(k).lower;
    Configuration seed = q;
    seed[k] += upper ? -0.01 : 0.01;
    const InverseResult result =
        inverse_kinematics(arm, forward_kinematics(arm, q), {.seed = seed, .all = true});
    const bool found = std::any_of(
        result.solutions.begin(), result.solutions.end(),
        [&](const Configuration& other) { return (other - q).lpNorm<Eigen::Infinity>() < 1e-5; });
    EXPECT_TRUE(found || !result.complete) << "case " << i << ": " << q.transpose();
  }
}

TEST(HardQuestions, EndlessTurnsAreNotComplete) {
  std::vector<Joint> joints;
  for (int i = 0; i < 2; ++i) {
    joints.push_back(
        testing::named(dh_joint({.a = 1}, DhConvention::standard), "j" + std::to_string(i), -7, 7));
  }
  const Pose pose = make_pose({1.2, 0.3, 0});
  const InverseOptions options{.task = Task::position(), .all = true, .every_turn = true};
  EXPECT_TRUE(inverse_kinematics(Arm("limited", joints), pose, options).complete);
  joints[0].limits.upper = Limits::none;
  const InverseResult result = inverse_kinematics(Arm("endless", joints), pose, options);
  EXPECT_FALSE(result.complete);
  EXPECT_TRUE(result.branches_complete);
}

/// An arm of seven joints between axes at right angles, one of them prismatic, three of them
/// parallel; at q within its limits.
Arm slider(testing::Random& random, const Configuration& q) {
  const double lengths[] = {0, 0.2, 0.3, 0.5};
  const auto length = [&] { return lengths[random.integer(0, 3)]; };
  std::vector<Joint> joints;
  const int slide = random.integer(0, 1) == 0 ? 6 : 0, parallel = random.integer(1, 3);
  for (int k = 0; k < 7; ++k) {
    const bool turned = k < parallel || k > parallel + 1;
    Joint joint = dh_joint({.a = length(),
                            .alpha = turned ? random.integer(1, 3) * pi / 2 : 0,
                            .d = length(),
                            .kind = k == slide ? JointKind::prismatic : JointKind::revolute},
                           DhConvention::standard);
    const double range = k == slide ? 0.01 : 4;
    joints.push_back(testing::named(joint, "j" + std::to_string(k), q[k] - random.uniform(0, range),
                                    q[k] + random.uniform(0, range)));
  }
  return {"slider", joints};
}

TEST(HardQuestions, ASlideThatAnEquationDoesNotDetermineMakesNothingUnreachable) {
  testing::Random random;
  int solved = 0;
  const int asked = testing::cases(1000);
  for (int i = 0; i < asked; ++i) {
    Configuration q(7);
    for (double& value : q) value = random.uniform(-2, 2);
    q[random.integer(1, 5)] = random.integer(-1, 1) * pi / 2;
    const Arm arm = slider(random, q);
    const InverseResult result = inverse_kinematics(arm, forward_kinematics(arm, q));
    solved += result ? 1 : 0;
    EXPECT_NE(result.status, InverseStatus::orientation_unreachable) << i << result.reason;
    EXPECT_NE(result.status, InverseStatus::unreachable) << i << result.reason;
  }
  EXPECT_GE(solved, asked * 9 / 10);
}

TEST(HardQuestions, ArmsOfAnySizeWithoutABoundedReachAreSolved) {
  testing::Random random;
  for (const double scale : {1e-3, 1.0, 1e3}) {
    int solved = 0;
    const int asked = testing::cases(100);
    for (int i = 0; i < asked; ++i) {
      std::vector<Joint> joints;
      for (int k = 0; k < 7; ++k) {
        const JointKind kind = k == 3 ? JointKind::helical : JointKind::revolute;
        Joint joint = testing::random_joint(random, kind, "j" + std::to_string(k));
        joint.offset.translation() *= scale;
        joint.screw.head<3>() *= scale;
        if (k == 3) joint.limits = {};
        joints.push_back(joint);
      }
      const Arm arm("screwdriver", joints);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      solved += inverse_kinematics(arm, pose) ? 1 : 0;
    }
    EXPECT_GE(solved, asked * 8 / 10) << scale;
  }
}

TEST(HardQuestions, SlidesWithoutLimitsLeadAnywhere) {
  testing::Random random;
  std::vector<Joint> joints;
  for (int k = 0; k < 6; ++k) {
    const Vector3 axis = Vector3::Unit(k < 3 ? k : 5 - k);
    Joint joint;
    joint.name = "j" + std::to_string(k);
    joint.screw = k < 3 ? translation_screw(axis) : rotation_screw(axis);
    joints.push_back(joint);
  }
  const Arm arm("crane", joints, Pose(Eigen::Translation3d(0.1, 0, 0.05)));
  for (const double far : {1.0, 1e2, 1e3, 1e4}) {
    for (int i = 0; i < 20; ++i) {
      const Pose pose = random.pose(far);
      const InverseResult result = inverse_kinematics(arm, pose);
      EXPECT_NE(result.status, InverseStatus::unreachable) << far << result.reason;
      EXPECT_NE(result.status, InverseStatus::outside_limits) << far << result.reason;
    }
  }
}

}  // namespace
}  // namespace beeline
