#include <cmath>
#include <gtest/gtest.h>

#include <beeline/control/tracker.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/trajectory/trajectory.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

constexpr double dt = 1e-3;

/// Expects that a step keeps all limits after the last one.
void expect_within_limits(const Arm& arm, const TrackerStep& step, const Configuration& last_q,
                          const Configuration& last_velocity, double time_step) {
  ASSERT_TRUE(step.q.allFinite());
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits limits = motion_limits(arm.limits(k));
    ASSERT_GE(step.q[k], limits.lower) << k;
    ASSERT_LE(step.q[k], limits.upper) << k;
    ASSERT_LE(std::abs(step.q[k] - last_q[k]), limits.velocity * time_step + 1e-14) << k;
    ASSERT_NEAR(step.q[k] - last_q[k], step.velocity[k] * time_step, 1e-14) << k;
    const double change = std::abs(step.velocity[k] - last_velocity[k]);
    ASSERT_LE(change, limits.acceleration * time_step + 1e-12) << k;
  }
}

TEST(Tracker, KeepsAllLimitsForAnyCommand) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    for (const double time_step : {1e-3, 0.02}) {
      Configuration q = random.configuration(arm);
      Configuration velocity = Configuration::Zero(arm.dof());
      Tracker tracker(arm, q, {.time_step = time_step});
      Pose command = random.pose(2 * arm.reach().radius);
      for (int i = 0; i < testing::cases(4000); ++i) {
        if (i % 400 == 0) command = forward_kinematics(arm, random.configuration(arm));
        if (i % 400 == 200) command = random.pose(2);
        Pose noisy = command;
        noisy.translation() += random.vector(0.002);
        const TrackerStep& step = tracker.step(noisy);
        ASSERT_NO_FATAL_FAILURE(expect_within_limits(arm, step, q, velocity, time_step)) << name;
        q = step.q;
        velocity = step.velocity;
      }
    }
  }
}

TEST(Tracker, StaysAtRestAtItsPose) {
  testing::Random random;
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    const Configuration q = random.configuration(arm);
    Tracker tracker(arm, q);
    const Pose pose = forward_kinematics(arm, q);
    for (int i = 0; i < 100; ++i) {
      const TrackerStep& step = tracker.step(pose);
      EXPECT_EQ(step.status, TrackerStatus::following) << step;
      EXPECT_LT((step.q - q).lpNorm<Eigen::Infinity>(), 1e-12) << name;
    }
  }
}

TEST(Tracker, RefusesInvalidArguments) {
  const Arm arm = built_in("ur5");
  const Configuration q = Configuration::Constant(6, 0.3);
  EXPECT_REFUSED((Tracker(arm, q, {.time_step = 0})), "time step");
  EXPECT_REFUSED((Tracker(arm, q, {.tolerance = {0, 1}})), "tolerance");
  EXPECT_REFUSED((Tracker(arm, Configuration::Zero(5))), "5");
  EXPECT_REFUSED((Tracker(arm, Configuration::Constant(6, 7))), "outside");
}

}  // namespace
}  // namespace beeline
