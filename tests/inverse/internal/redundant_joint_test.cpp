#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/inverse/internal/joint_lock.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/model/catalog.h>

#include <tests/inverse/answer.h>
#include <tests/inverse/families.h>
#include <tests/inverse/internal/relative_margin.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using namespace internal;

using testing::cases;
using testing::expect_solved;
using testing::holds;
using testing::Random;
using testing::relative_margin;

TEST(LockedJoint, IsRecognisedAtEitherEnd) {
  Random random;
  for (const auto family : {PieperLoop::Family::intersecting, PieperLoop::Family::parallel}) {
    for (std::size_t first = 0; first < 4; ++first) {
      auto axes = axes_with(family, first, "RRRRRR", random);
      axes.push_back(testing::random_axis(random));
      auto form = PieperSolver::make(arm_through(axes, random), Task::spatial());
      ASSERT_TRUE(form);
      EXPECT_EQ(form->locked(), 6);
      std::rotate(axes.begin(), axes.begin() + 6, axes.end());
      // The six that begin at joint 1 may have a family too: then the last is locked again.
      form = PieperSolver::make(arm_through(axes, random), Task::spatial());
      ASSERT_TRUE(form);
      EXPECT_EQ(form->locked(), first < 3 ? 6 : 0);
    }
  }
}

TEST(LockedJoint, OfSevenComesBackAndStays) {
  Random random;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int k = 0; k < 7; ++k) {
      // With its elbow locked an iiwa has self-motions, and reaches some poses by infinitely many
      // configurations.
      if (k == 3 && arm.name() == "iiwa14") continue;
      SCOPED_TRACE(std::string(name) + " with coordinate " + std::to_string(k) + " locked");
      const bool quick = k == 6 || (k == 0 && arm.name() == "iiwa14");  // a family's closed form
      for (int i = 0; i < cases(quick ? 200 : 9); ++i) {
        const Configuration from = random.configuration(arm);
        Configuration seed = random.configuration(arm);
        seed[k] = from[k];
        const Pose pose = forward_kinematics(arm, from);
        const InverseResult all = inverse_kinematics(
            arm, pose, {.seed = seed, .all = true, .lock = k, .max_restarts = 50});
        expect_solved(arm, pose, Task::spatial(), all);
        EXPECT_TRUE(holds(arm, all.solutions, from)) << all.method;
        const InverseResult one = inverse_kinematics(arm, pose, {.seed = seed, .lock = k});
        expect_solved(arm, pose, Task::spatial(), one);
        for (const Configuration& q : all.solutions) EXPECT_EQ(q[k], seed[k]) << all.method;
        for (const Configuration& q : one.solutions) EXPECT_EQ(q[k], seed[k]) << one.method;
      }
    }
  }
}

TEST(LockedJoint, MissesNothingThatASearchFinds) {
  Random random;
  int poses = 0, equal = 0;
  for (const auto& [name, k] : {std::pair{"panda", 6}, {"iiwa14", 6}, {"iiwa14", 0}}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < 10; ++i) {
      const Configuration from = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, from);
      const InverseResult all = inverse_kinematics(
          arm, pose, {.seed = from, .all = true, .ignore_limits = true, .lock = k});
      EXPECT_EQ(all.solutions.size() % 2, 0U);
      const Arm rest = with_locked(arm, k, from[k]);
      const auto found = search_all(rest, pose, Task::spatial(), all.solutions.size(), 500, random);
      ++poses;
      equal += found.size() == all.solutions.size();
      for (const Configuration& q : found) {
        EXPECT_TRUE(holds(arm, all.solutions, with(q, k, from[k]), 1e-4)) << name;
      }
    }
  }
  EXPECT_GE(equal, 0.9 * poses) << "of " << poses;
}

TEST(LockedJoint, OutsideItsLimitsIsRefused) {
  for (const int k : {0, 3, 6}) {
    const Arm arm = built_in("panda");
    Configuration seed = middle_configuration(arm);
    const Pose pose = forward_kinematics(arm, seed);
    seed[k] = arm.limits(k).upper + 0.1;
    const InverseOptions options{.seed = seed, .lock = k};
    EXPECT_REFUSED(inverse_kinematics(arm, pose, options), arm.joint_of(k).name);
    Eigen::MatrixXd solutions(7, 1);
    EXPECT_REFUSED(inverse_kinematics(arm, pose, seed, solutions, {.lock = k}),
                   arm.joint_of(k).name);
  }
}

/// The locked coordinate plus 2 pi is another value of it.
TEST(LockedJoint, IsNotTurnedAround) {
  Random random;
  std::vector<Joint> joints = built_in("iiwa14").joints();
  for (Joint& joint : joints) joint.limits.lower = -7, joint.limits.upper = 7;
  const Arm arm("wide", joints);
  for (const int k : {0, 6}) {
    for (int i = 0; i < 20; ++i) {
      const Configuration seed = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, seed);
      const InverseResult every =
          inverse_kinematics(arm, pose, {.seed = seed, .all = true, .every_turn = true, .lock = k});
      expect_solved(arm, pose, Task::spatial(), every);
      for (const Configuration& q : every.solutions) EXPECT_EQ(q[k], seed[k]);
    }
  }
}

/// All solutions within limits for `count` values of the last coordinate.
std::vector<Configuration> sweep(const Arm& arm, const Pose& pose, const Configuration& seed,
                                 int count) {
  std::vector<Configuration> found;
  Eigen::MatrixXd solutions(7, 8);
  const Limits& limits = arm.limits(6);
  Configuration start = seed;
  for (int i = 0; i < count; ++i) {
    const double fraction = static_cast<double>(i) / (count - 1);
    start[6] = (1 - fraction) * limits.lower + fraction * limits.upper;
    const int solved = inverse_kinematics(arm, pose, start, solutions, {.all = true, .lock = 6});
    for (int k = 0; k < solved; ++k) found.emplace_back(solutions.col(k));
  }
  return found;
}

TEST(LockedJoint, TheNearestIsNearerThanAnyOfItsGrid) {
  Random random;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(100); ++i) {
      const int grid = random.integer(0, 3) == 0 ? 500 : 32;
      const Configuration seed = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      const InverseResult nearest = inverse_kinematics(
          arm, pose, {.seed = seed, .redundancy = Redundancy::nearest, .grid = grid});
      expect_solved(arm, pose, Task::spatial(), nearest);
      const double distance = (nearest.solutions[0] - seed).norm();
      double least = 1e9;
      for (const auto& q : sweep(arm, pose, seed, grid)) least = std::min(least, (q - seed).norm());
      EXPECT_LE(distance, least + 1e-9) << name;
    }
  }
}

TEST(LockedJoint, TheCentredIsFartherFromLimitsThanAnyOfItsGrid) {
  Random random;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < cases(100); ++i) {
      const int grid = random.integer(0, 3) == 0 ? 500 : 32;
      const Configuration seed = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      const InverseResult centred = inverse_kinematics(
          arm, pose, {.seed = seed, .redundancy = Redundancy::centred, .grid = grid});
      expect_solved(arm, pose, Task::spatial(), centred);
      double most = 0;
      for (const auto& q : sweep(arm, pose, seed, grid))
        most = std::max(most, relative_margin(arm, q));
      EXPECT_GE(relative_margin(arm, centred.solutions[0]), most - 1e-9) << name;
    }
  }
}

// Where every branch is outside the limits throughout the range of the redundant joint, no search
// follows.
TEST(LockedJoint, APoseThatIsRefusedHasNoSolutionAtAnyValue) {
  Random random;
  int refused = 0, searched = 0;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    Eigen::MatrixXd column(7, 1);
    for (int i = 0; i < cases(150); ++i) {
      Pose pose = forward_kinematics(arm, random.configuration(arm));
      pose.linear() = random.pose().linear();
      const Configuration seed = random.configuration(arm);
      const InverseResult result = inverse_kinematics(arm, pose, {.seed = seed});
      EXPECT_EQ(inverse_kinematics(arm, pose, seed, column),
                static_cast<int>(result.solutions.size()));
      if (result) continue;
      ++refused;
      searched += result.restarts > 0;
      EXPECT_TRUE(sweep(arm, pose, seed, 1500).empty()) << name << ' ' << result.reason;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_LE(searched, refused / 4);
}

TEST(LockedJoint, AGridHasTheSolutionsOfEachOfItsValues) {
  Random random;
  for (const char* name : {"panda", "iiwa14"}) {
    const Arm arm = built_in(name);
    for (const int grid : {2, 7, 32}) {
      int compared = 0;
      for (int i = 0; i < 20; ++i) {
        const Configuration seed = random.configuration(arm);
        const Pose pose = forward_kinematics(arm, random.configuration(arm));
        const auto expected = sweep(arm, pose, seed, grid);
        const InverseResult all =
            inverse_kinematics(arm, pose, {.seed = seed, .all = true, .grid = grid});
        if (expected.empty()) continue;  // then the numerical stage may find others
        ++compared;
        expect_solved(arm, pose, Task::spatial(), all);
        EXPECT_EQ(all.solutions.size(), expected.size());
        for (const Configuration& q : expected) EXPECT_TRUE(holds(arm, all.solutions, q));
      }
      EXPECT_GE(compared, grid == 2 ? 1 : 10) << name << ' ' << grid;
    }
  }
}

TEST(LockedJoint, GridValuesReachFromLimitToLimit) {
  const Arm arm = built_in("panda");
  const auto form = PieperSolver::make(arm, Task::spatial());
  const Configuration far = Configuration::Constant(7, 9);
  const LockedRange range = locked_range(arm, bounds_of(arm), far, *form->locked(), form->size());
  EXPECT_EQ(range.lower, arm.limits(6).lower);
  EXPECT_EQ(range.upper, arm.limits(6).upper);
  EXPECT_EQ(range.seed, range.upper);
  const std::vector<double> values = grid_values(range, 5);
  ASSERT_EQ(values.size(), 5U);
  EXPECT_EQ(values.front(), range.lower);
  EXPECT_EQ(values.back(), range.upper);
  const LockedRange open = locked_range(arm, no_bounds(arm), far, *form->locked(), form->size());
  EXPECT_NEAR(open.lower, 9 - 3.14159265, 1e-6);
  EXPECT_NEAR(open.upper, 9 + 3.14159265, 1e-6);
}

}  // namespace
}  // namespace beeline
