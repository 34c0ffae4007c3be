#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

#include <beeline/control/tracker.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/trajectory/trajectory.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>
#include <tests/typical_arms.h>

namespace beeline {
namespace {

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

/// Commands that jump within reach and beyond, with noise.
void follow_jumps(const Arm& arm, testing::Random& random, const TrackerOptions& options) {
  Configuration q = random.configuration(arm);
  Configuration velocity = Configuration::Zero(arm.dof());
  Tracker tracker(arm, q, options);
  Pose command = random.pose(3);
  const double noise = random.integer(0, 2) * 0.002;
  const int steps = testing::example_size(3000);
  for (int i = 0; i < steps; ++i) {
    if (i % 400 == 0) command = forward_kinematics(arm, random.configuration(arm));
    if (i % 400 == 300) command = random.pose(3);
    Pose noisy = command;
    noisy.translation() += random.vector(noise);
    const TrackerStep& step = tracker.step(noisy);
    ASSERT_NO_FATAL_FAILURE(expect_within_limits(arm, step, q, velocity, options.time_step));
    // A status other than `following` has its reason.
    ASSERT_EQ(step.status == TrackerStatus::limited, step.joint.has_value()) << step;
    ASSERT_EQ(step.status == TrackerStatus::limited, step.limit != ServoLimit::none) << step;
    ASSERT_EQ(step.status == TrackerStatus::following, within(step.error, options.tolerance))
        << step;
    q = step.q;
    velocity = step.velocity;
  }
}

TEST(Tracker, KeepsAllLimitsForAnyCommand) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
    for (const double time_step : {1e-3, 0.02}) {
      ASSERT_NO_FATAL_FAILURE(follow_jumps(built_in(name), random, {.time_step = time_step}))
          << name;
    }
  }
}

TEST(Tracker, KeepsAllLimitsOfRandomArms) {
  testing::Random random;
  const char* tasks[] = {"spatial", "position", "111110:tool"};
  for (int i = 0; i < testing::cases(20); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 9), 4);
    TrackerOptions options{task_named(tasks[i % 3])};
    if (i % 4 == 0) options.command_period = 0.01;
    ASSERT_NO_FATAL_FAILURE(follow_jumps(arm, random, options)) << i;
  }
}

TEST(Tracker, KeepsExtremeLimits) {
  testing::Random random;
  const Arm panda = built_in("panda");
  const double extremes[] = {1e-9, 1e-3, 1, 1e6, 1e10, Limits::none};
  for (int i = 0; i < testing::cases(30); ++i) {
    std::vector<Joint> joints = panda.joints();
    for (Joint& joint : joints) {
      joint.limits.velocity = extremes[random.integer(0, 5)];
      joint.limits.acceleration = extremes[random.integer(0, 5)];
      if (random.integer(0, 3) == 0) joint.limits.upper = joint.limits.lower + 1e-12;
      if (random.integer(0, 3) == 0) joint.limits.lower = joint.limits.upper;
    }
    const Arm arm("extreme", joints, panda.tool());
    TrackerOptions options;
    options.time_step = std::pow(10, random.integer(-9, 3));
    Tracker tracker(arm, random.configuration(arm), options);
    Configuration velocity = tracker.velocity();
    for (int k = 0; k < 200; ++k) {
      Pose goal = forward_kinematics(arm, random.configuration(arm));
      if (k % 7 == 0) goal.translation() *= 1e90;
      const TrackerStep& step = tracker.step(goal);
      for (int j = 0; j < 7; ++j) {
        const Limits& limits = arm.limits(j);
        ASSERT_TRUE(within_position_limits(limits, step.q[j], 0)) << j;
        ASSERT_LE(std::abs(step.velocity[j]), limits.velocity) << j;
        const double max_change = limits.acceleration * options.time_step;
        ASSERT_LE(std::abs(step.velocity[j] - velocity[j]),
                  (1 + 1e-9) * max_change + 1e-12 * std::abs(velocity[j]))
            << j;
      }
      velocity = step.velocity;
    }
  }
}

TEST(Tracker, StaysAtRestAtItsPose) {
  testing::Random random;
  for (const std::string& name : testing::typical_arms) {
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

TEST(Tracker, ReportsTheLimitThatLetsItLag) {
  Joint slide = built_in("gantry").joints()[0];
  slide.limits = {.lower = -2, .upper = 1, .velocity = 0.5};
  const Arm arm("slide", {slide});
  const auto pose_at = [&](double q) {
    return forward_kinematics(arm, Configuration::Constant(1, q));
  };
  Tracker tracker(arm, {0.0}, {.task = Task::position()});
  TrackerStep step = tracker.step(pose_at(0.4));
  EXPECT_EQ(step.status, TrackerStatus::limited);
  EXPECT_EQ(step.limit, ServoLimit::acceleration);
  EXPECT_EQ(step.joint, 0);
  EXPECT_TRUE(step.assumed);
  for (int i = 1; i < 400; ++i) step = tracker.step(pose_at(0.4));
  EXPECT_EQ(step.limit, ServoLimit::velocity);
  EXPECT_FALSE(step.assumed);
  EXPECT_NEAR(step.velocity[0], 0.5, 1e-12);
  EXPECT_NEAR(step.error.position, 0.4 - step.q[0], 1e-12);
  for (int i = 400; i < 2000; ++i) step = tracker.step(pose_at(0.4));
  EXPECT_EQ(step.status, TrackerStatus::following);
  EXPECT_NEAR(step.q[0], 0.4, 1e-12);
  EXPECT_NEAR(step.velocity[0], 0, 1e-9);
  for (int i = 0; i < 4000; ++i) step = tracker.step(pose_at(1.5));
  EXPECT_EQ(step.limit, ServoLimit::position);
  EXPECT_NEAR(step.q[0], 1, 1e-9);
  Pose aside = pose_at(1);
  aside.translation() += Vector3(0, 0, 0.1);  // no joint moves the tool there
  for (int i = 0; i < 100; ++i) step = tracker.step(aside);
  EXPECT_EQ(step.status, TrackerStatus::unreachable) << step;
}

TEST(Tracker, CopiesContinueIndependentlyAndMovesKeepTheState) {
  testing::Random random;
  const Arm arm = built_in("panda");
  const Configuration q = middle_configuration(arm);
  const Pose goal = forward_kinematics(arm, q + Configuration::Constant(7, 0.2));
  const Pose other = forward_kinematics(arm, q - Configuration::Constant(7, 0.2));
  Tracker tracker(arm, q, {.command_period = 0.01});
  for (int i = 0; i < 50; ++i) tracker.step(goal);
  Tracker copy = tracker;
  for (int i = 0; i < 50; ++i) tracker.step(other);  // does not change the copy
  Tracker assigned(built_in("rrr"), {0, 0, 0});
  assigned = copy;
  Tracker moved = std::move(copy);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(assigned.step(goal).q, moved.step(goal).q);  // exactly
  }
  EXPECT_NE(assigned.configuration(), tracker.configuration());
  assigned.reset(q);
  EXPECT_EQ(assigned.configuration(), q);
  EXPECT_EQ(assigned.velocity(), Configuration::Zero(7));
  Tracker fresh(arm, q, {.command_period = 0.01});
  for (int i = 0; i < 50; ++i) EXPECT_EQ(assigned.step(goal).q, fresh.step(goal).q);
}

TEST(Tracker, StepsArePrinted) {
  std::ostringstream text;
  TrackerStep step;
  text << step << "; ";
  step.status = TrackerStatus::limited;
  step.limit = ServoLimit::velocity;
  step.joint = 1;
  step.assumed = true;
  step.error = {0.01, 0.2};
  text << step;
  EXPECT_EQ(text.str(),
            "following, error 0 m, 0 rad; limited, limit velocity of joint 2 (assumed), error 0.01 "
            "m, 0.2 rad");
}

TEST(Tracker, StartsAtItsLimitsUpToRounding) {
  const Arm arm = built_in("panda");
  Configuration q = middle_configuration(arm);
  q[3] = arm.limits(3).upper + 0.5 * position_slack;
  Tracker tracker(arm, q);
  EXPECT_EQ(tracker.configuration()[3], arm.limits(3).upper);
  q[3] += position_slack;
  EXPECT_REFUSED(tracker.reset(q), "start of a tracker");
}

TEST(Tracker, RefusesInvalidArguments) {
  const Arm arm = built_in("ur5");
  const Configuration q = Configuration::Constant(6, 0.3);
  EXPECT_REFUSED((Tracker(arm, q, {.time_step = 0})), "time step");
  EXPECT_REFUSED((Tracker(arm, q, {.time_step = INFINITY})), "time step");
  EXPECT_REFUSED((Tracker(arm, q, {.command_period = -1})), "command period");
  EXPECT_REFUSED((Tracker(arm, q, {.command_period = NAN})), "command period");
  EXPECT_REFUSED((Tracker(arm, q, {.tolerance = {0, 1}})), "tolerance");
  EXPECT_REFUSED((Tracker(arm, q, {.task = Task{{}}})), "row");
  EXPECT_REFUSED((Tracker(arm, Configuration::Zero(5))), "5");
  EXPECT_REFUSED((Tracker(arm, Configuration::Constant(6, 7))), "start of a tracker");
  EXPECT_REFUSED((Tracker(arm, Configuration::Constant(6, NAN))), "finite");
}

TEST(Tracker, RefusedCommandsChangeNothing) {
  const Arm arm = built_in("ur5");
  const Configuration q = Configuration::Constant(6, 0.3);
  const Pose goal = forward_kinematics(arm, q + Configuration::Constant(6, 0.1));
  for (const double period : {0.0, 0.02}) {
    Tracker tracker(arm, q, {.command_period = period});
    for (int i = 0; i < 20; ++i) tracker.step(goal);
    Tracker copy = tracker;
    Pose bad = goal;
    bad.translation()[1] = NAN;
    EXPECT_REFUSED(tracker.step(bad), "commanded pose");
    bad.translation()[1] = 1e99;
    EXPECT_TRUE(Tracker(tracker).step(bad).q.allFinite());
    bad = goal;
    bad.linear() *= 2;
    EXPECT_REFUSED(tracker.step(bad), "commanded pose");
    EXPECT_REFUSED(tracker.reset(Configuration::Constant(6, 7)), "start of a tracker");
    for (int i = 0; i < 50; ++i) EXPECT_EQ(tracker.step(goal).q, copy.step(goal).q);
  }
}

}  // namespace
}  // namespace beeline
