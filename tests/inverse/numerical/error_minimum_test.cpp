#include <gtest/gtest.h>

#include <beeline/inverse/numerical/error_minimum.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

using testing::Random;

constexpr double least = 1e-5;

double half_square(const Arm& arm, const Pose& pose, const Configuration& q) {
  return 0.5 * task_error(Task::spatial(), pose, forward_kinematics(arm, q)).squaredNorm();
}

/// A configuration next to q, moved by up to `away` in each joint, within the limits.
Configuration beside(const Arm& arm, const Configuration& q, double away, Random& random) {
  Configuration moved = q;
  for (double& value : moved) value += random.uniform(-away, away);
  return clamped(bounds_of(arm), moved);
}

TEST(ErrorMinimum, IsALocalMinimumWithinTheLimits) {
  Random random;
  int found = 0;
  const int poses = testing::cases(100);
  for (const char* name : {"ur5", "rizon4", "crx10ia"}) {
    const Arm arm = built_in(name);
    const Bounds bounds = bounds_of(arm);
    for (int i = 0; i < poses; ++i) {
      Pose pose = forward_kinematics(arm, random.configuration(arm));
      pose.translation() *= 1.5;
      Configuration q =
          levenberg_marquardt(arm, pose, Task::spatial(), bounds, random.configuration(arm)).q;
      if (!minimise_error(arm, pose, Task::spatial(), bounds, least, unlimited(), q)) continue;
      ++found;
      EXPECT_TRUE(within(bounds, q));
      const double smallest = half_square(arm, pose, q);
      EXPECT_GT(std::sqrt(2 * smallest), least * std::min(1.0, unit_of_length(arm)));
      for (int k = 0; k < 20; ++k) {
        const double there = half_square(arm, pose, beside(arm, q, 1e-3, random));
        EXPECT_GE(there, smallest - 1e-12);
      }
    }
  }
  EXPECT_GE(found, poses / 3);
}

TEST(ErrorMinimum, IsNotNextToASolution) {
  Random random;
  for (const char* name : {"ur5", "panda", "rizon4", "crx10ia", "hc10"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(100); ++i) {
      Configuration q = random.configuration(arm);
      if (i % 3 == 1) q[2] = q[4] = 0;  // singular for most of these arms
      if (i % 3 == 2) q = middle_configuration(arm);
      q = clamped(bounds_of(arm), q);
      const Pose pose = forward_kinematics(arm, q);
      Configuration from = beside(arm, q, 1e-3, random);
      EXPECT_FALSE(
          minimise_error(arm, pose, Task::spatial(), bounds_of(arm), least, unlimited(), from))
          << q;
    }
  }
}

TEST(ErrorMinimum, EndsByTheBudget) {
  Random random;
  const Arm arm = built_in("ur5");
  int steps = 0;
  for (int i = 0; i < testing::cases(20); ++i) {
    Pose pose = forward_kinematics(arm, random.configuration(arm));
    pose.translation() *= 1.5;
    const Configuration q = random.configuration(arm);
    Configuration whole = q;
    minimise_error(arm, pose, Task::spatial(), bounds_of(arm), least, unlimited(), whole);
    Budget limits;
    limits.max_work = 1;
    BudgetMeter budget(limits);
    Configuration ended = q;
    EXPECT_FALSE(minimise_error(arm, pose, Task::spatial(), bounds_of(arm), least, budget, ended));
    steps += whole != ended;
    EXPECT_LE(budget.spent().work, 2);
  }
  EXPECT_GE(2 * steps, testing::cases(20));
}

}  // namespace
}  // namespace beeline::internal
