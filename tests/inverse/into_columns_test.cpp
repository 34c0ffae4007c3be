#include <cerrno>
#include <cstdlib>
#include <gtest/gtest.h>
#include <optional>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/model/catalog.h>

#include <tests/allocations.h>
#include <tests/inverse/answer.h>
#include <tests/inverse/families.h>
#include <tests/refusal.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

using testing::expect_solved;
using testing::Random;

const char* const six_joints[] = {"puma560", "ur5", "ur5e", "stanford"};
const char* const seven_joints[] = {"panda", "iiwa14"};

TEST(IntoColumns, GivesWhatAResultHas) {
  Random random;
  for (const char* name : six_joints) {
    const Arm arm = built_in(name);
    for (const bool ignore_limits : {false, true}) {
      const InverseOptions options{.all = true, .ignore_limits = ignore_limits};
      for (int i = 0; i < 500; ++i) {
        const Configuration seed = random.configuration(arm);
        const Pose pose = forward_kinematics(arm, random.configuration(arm));
        InverseOptions with_seed = options;
        with_seed.seed = seed;
        const auto expected = inverse_kinematics(arm, pose, with_seed).solutions;
        Eigen::MatrixXd columns(6, 8);
        const int count = inverse_kinematics(arm, pose, seed, columns, options);
        ASSERT_EQ(static_cast<std::size_t>(count), expected.size()) << name;
        for (int k = 0; k < count; ++k) {
          EXPECT_LT((columns.col(k) - expected[k]).norm(), 1e-7) << name;
        }
      }
    }
  }
}

TEST(IntoColumns, IntoFewColumnsWritesTheNearestOnly) {
  Random random;
  for (const char* name : six_joints) {
    const Arm arm = built_in(name);
    const InverseOptions all{.all = true};
    for (int i = 0; i < 300; ++i) {
      const Configuration seed = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      Eigen::MatrixXd eight(6, 8), two(6, 2), single(6, 1);
      const int count = inverse_kinematics(arm, pose, seed, eight, all);
      ASSERT_GE(count, 1);
      EXPECT_EQ(inverse_kinematics(arm, pose, seed, two, all), std::min(count, 2));
      EXPECT_EQ(two.leftCols(std::min(count, 2)), eight.leftCols(std::min(count, 2)));
      EXPECT_EQ(inverse_kinematics(arm, pose, seed, single), 1);
      EXPECT_LT((single - eight.col(0)).norm(), 1e-7) << name;
    }
  }
}

/// Whatever the arm, what comes back reaches the pose within limits.
TEST(IntoColumns, SolvesEveryBuiltInArm) {
  Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    Eigen::MatrixXd column(arm.dof(), 1);
    int missed = 0;
    for (int i = 0; i < 1000; ++i) {
      const Configuration seed = random.configuration(arm);
      const Configuration from = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, from);
      if (inverse_kinematics(arm, pose, seed, column) != 1) {
        // A few poses in a million are missed where a redundant joint has to be searched for.
        EXPECT_EQ(arm.dof(), 7) << name << ' ' << from.transpose();
        ++missed;
        continue;
      }
      EXPECT_TRUE(within(internal::bounds_of(arm), column.col(0)))
          << name << ' ' << column.transpose();
      const Pose reached = forward_kinematics(arm, column.col(0));
      EXPECT_LE(testing::largest(task_deviation(default_task(arm), pose, reached)), 1e-10) << name;
    }
    EXPECT_LE(missed, 1) << name;
    Pose away = Pose::Identity();
    away.translation().x() = 100;
    if (arm.reach().radius < 90) {
      EXPECT_EQ(inverse_kinematics(arm, away, middle_configuration(arm), column), 0);
    }
  }
}

TEST(IntoColumns, KeepsALockedCoordinate) {
  Random random;
  for (const char* name : seven_joints) {
    const Arm arm = built_in(name);
    const InverseOptions options{.all = true, .lock = 6};
    Eigen::MatrixXd columns(7, 8);
    for (int i = 0; i < 300; ++i) {
      const Configuration from = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, from);
      const int count = inverse_kinematics(arm, pose, from, columns, options);
      ASSERT_GE(count, 1) << name;
      EXPECT_LT((columns.col(0) - from).norm(), 1e-6);
      for (int k = 0; k < count; ++k) EXPECT_EQ(columns(6, k), from[6]);
      const auto all = inverse_kinematics(arm, pose, {.seed = from, .all = true, .lock = 6});
      EXPECT_EQ(static_cast<std::size_t>(count), all.solutions.size()) << name;
    }
  }
}

TEST(IntoColumns, DoesNotAllocateInTheOrdinaryCourse) {
#if !BEELINE_COUNTS_ALLOCATIONS
  GTEST_SKIP() << "allocations cannot be counted here";
#endif
  Random random;
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    if (default_task(arm) == Task::planar()) continue;
    const bool spare = arm.dof() == 7;
    const InverseOptions options{.all = !spare};
    Eigen::MatrixXd columns(arm.dof(), spare ? 1 : 8);
    int allocating = 0, poses = 500;
    for (int i = 0; i < poses; ++i) {
      const Configuration seed = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      const long before = allocations;
      const int count = inverse_kinematics(arm, pose, seed, columns, options);
      // The first call may fill buffers, and what needs a second look is out of the ordinary.
      if (allocations != before && i > 0) ++allocating;
      EXPECT_GE(count, 1);
    }
    EXPECT_LE(allocating, poses / 100) << name;
  }
  const long before = allocations;
  std::free(std::malloc(8));
  Eigen::MatrixXd matrix(3, 3);
  EXPECT_GE(allocations, before + 1);
  EXPECT_GT(matrix.size(), 0);
}

TEST(InverseMethod, IsTheClosedFormOrNumerical) {
  for (const char* name : {"puma560", "ur5", "panda", "scara", "rrr"}) {
    const Arm arm = built_in(name);
    EXPECT_TRUE(has_closed_form(arm));
    EXPECT_EQ(inverse_method(arm).substr(0, 13), "closed form: ");
    EXPECT_FALSE(has_closed_form(arm, {.method = InverseMethod::numerical}));
    EXPECT_EQ(inverse_method(arm, {.method = InverseMethod::numerical}), "numerical");
  }
  EXPECT_FALSE(has_closed_form(built_in("crx10ia")));  // for one solution a search takes less time
  EXPECT_TRUE(has_closed_form(built_in("crx10ia"), {.all = true}));
}

TEST(IntoColumns, RefusesWhatDoesNotFit) {
  const Arm arm = built_in("puma560");
  const InverseOptions all{.all = true};
  const Configuration seed = Configuration::Zero(6);
  const Pose pose = forward_kinematics(arm, Configuration::Constant(6, 0.3));
  Eigen::MatrixXd columns(6, 8), narrow(5, 8), wide(7, 8), none(6, 0);
  EXPECT_EQ(testing::refusal([&] { inverse_kinematics(arm, pose, seed, columns, all); }),
            "accepted");
  for (Eigen::MatrixXd* each : {&narrow, &wide, &none}) {
    EXPECT_REFUSED(inverse_kinematics(arm, pose, seed, *each, all), "6 rows");
  }
  for (const int size : {0, 5, 7}) {
    const Configuration other = Configuration::Zero(size);
    EXPECT_REFUSED(inverse_kinematics(arm, pose, other, columns, all), "6");
    EXPECT_REFUSED(inverse_kinematics(arm, pose, {.seed = other}), "6");
  }
  for (const double bad : {std::nan(""), Limits::none}) {
    Configuration wrong = seed;
    wrong[2] = bad;
    EXPECT_REFUSED(inverse_kinematics(arm, pose, wrong, columns, all), "finite");
    Pose broken = pose;
    broken.translation().y() = bad;
    EXPECT_REFUSED(inverse_kinematics(arm, broken, seed, columns, all), "finite");
    EXPECT_REFUSED(inverse_kinematics(arm, broken), "finite");
  }
  Pose scaled = pose;
  scaled.linear() *= 1.1;
  EXPECT_REFUSED(inverse_kinematics(arm, scaled, seed, columns, all), "rigid");
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.every_turn = true}), "all");
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.lock = 6}), "0 to 5");
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.grid = 1}), "grid");
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.budget = {.time_limit = -1e-9}}), "time_limit");
  EXPECT_REFUSED(inverse_kinematics(arm, pose, {.budget = {.max_work = -1}}), "max_work");
}

TEST(IntoColumns, ATimeLimitEndsASearch) {
  Random random;
  std::vector<testing::Axis> axes(30);
  for (testing::Axis& axis : axes) axis = testing::random_axis(random, false, 0.1);
  const Arm arm = arm_through(axes, random, 0.1);
  const Pose reached = forward_kinematics(arm, random.configuration(arm));
  for (const double factor : {1.5, 100.0}) {  // a ball that it cannot leave
    Pose pose = reached;
    pose.translation() = arm.reach().centre + factor * arm.reach().radius * random.direction();
    InverseResult result =
        inverse_kinematics(arm, pose, {.max_restarts = 1'000'000, .budget = {.time_limit = 0.01}});
    explain(result, {.time_limit = 0.01});
    testing::expect_no(result, result.status);
    EXPECT_NE(result.status, InverseStatus::solved);
    EXPECT_GT(result.residual, 0);
    EXPECT_TRUE(result.nearest && result.nearest->q.allFinite());
  }
  const InverseResult result = inverse_kinematics(arm, reached, {.budget = {.time_limit = 10.0}});
  expect_solved(arm, reached, Task::spatial(), result);
}

}  // namespace
}  // namespace beeline
