#include <gtest/gtest.h>
#include <sstream>

#include <beeline/control/tracker.h>

#include <tests/allocations.h>
#include <tests/control/servo_cell.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::distance_rounding;
using testing::excess_at;
using testing::loop_step;
using testing::LoopLimits;

class AnyPose : public ::testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(AnyPose, KeepsTheClearanceAndTheLimits) {
  const auto& [name, cell] = GetParam();
  testing::Random random;
  const Arm arm = testing::loop_arm(name, LoopLimits::accelerations);
  const CollisionModel model = testing::loop_model(arm, name, testing::loop_scene(cell));
  int held = 0;
  const int runs = testing::cases(9), few = 3;
  for (int run = 0; run < runs; ++run) {
    const Configuration start = testing::clear_configuration(random, arm, model);
    Tracker tracker(arm, start, {.model = &model});
    Eigen::VectorXd before = Eigen::VectorXd::Zero(arm.dof());
    Pose command;
    for (int i = 0; i < 1400; ++i) {
      if (i % 350 == 0) {
        command = forward_kinematics(arm, random.configuration(arm));
        if (std::string(cell) == "itself") command.translation() *= 0.2;
      }
      const long allocated = allocations;
      const TrackerStep& step = tracker.step(command);
      ASSERT_EQ(allocations, allocated);
      if (step.limit == ServoLimit::clearance) ++held;
      ASSERT_TRUE(step.proved);
      ASSERT_EQ(step.bodies.has_value(), step.limit == ServoLimit::clearance);
      ASSERT_GE(excess_at(model, step.q), -distance_rounding) << run << ' ' << i;
      ASSERT_GE(excess_at(model, step.q - loop_step / 2 * step.velocity), -distance_rounding);
      ASSERT_TRUE(limit_violations(arm, step.q).empty());
      for (int k = 0; k < arm.dof(); ++k) {
        ASSERT_LE(std::abs(step.velocity[k]), arm.limits(k).velocity + 1e-9);
        ASSERT_LE(std::abs(step.velocity[k] - before[k]),
                  arm.limits(k).acceleration * loop_step + 1e-9);
      }
      before = step.velocity;
    }
  }
  EXPECT_TRUE(held > 0 || runs < few);
}

INSTANTIATE_TEST_SUITE_P(Tracker, AnyPose,
                         ::testing::Combine(::testing::Values("panda", "ur5e"),
                                            ::testing::Values("wall", "corner", "itself")));

/// The panda in front of a wall at x = 0.55 m.
struct TrackerAtWall {
  TrackerAtWall()
      : arm(testing::loop_arm("panda", LoopLimits::accelerations)),
        model(testing::loop_model(arm, "panda", testing::loop_scene("wall"))),
        q(7) {
    q << 0, -0.3, 0, -2.2, 0, 2.0, 0.785;
    home = forward_kinematics(arm, q);
  }

  Arm arm;
  CollisionModel model;
  Configuration q;
  Pose home;
};

TEST(TrackerClearance, SlidesToTheNearestPose) {
  const TrackerAtWall at;
  Tracker tracker(at.arm, at.q, {.model = &at.model});
  Pose command = at.home;
  command.translation() += Vector3(0.3, 0.15, -0.1);  // behind the wall
  TrackerStep step;
  for (int i = 0; i < 4000; ++i) {
    step = tracker.step(command);
    ASSERT_GE(excess_at(at.model, step.q), -distance_rounding);
  }
  EXPECT_EQ(step.status, TrackerStatus::limited);
  EXPECT_EQ(step.limit, ServoLimit::clearance);
  ASSERT_TRUE(step.bodies.has_value());
  EXPECT_EQ((*step.bodies)[1], "wall");
  const Pose reached = forward_kinematics(at.arm, step.q);
  EXPECT_NEAR(reached.translation().y(), command.translation().y(), 2e-3);
  EXPECT_NEAR(reached.translation().z(), command.translation().z(), 2e-3);
  EXPECT_LT(excess_at(at.model, step.q), 1e-4);
  EXPECT_LT(step.velocity.norm(), 5e-3);

  for (int i = 0; i < 3000; ++i) step = tracker.step(at.home);  // and back
  EXPECT_EQ(step.status, TrackerStatus::following);
}

TEST(TrackerClearance, FollowsASlowCommandAlongTheWallWithoutLag) {
  const TrackerAtWall at;
  Tracker tracker(at.arm, at.q, {.model = &at.model});
  Pose command = at.home;
  for (int i = 0; excess_at(at.model, tracker.configuration()) > 2e-3; ++i) {
    ASSERT_LT(i, 5000);
    command.translation().x() += 2e-5;
    tracker.step(command);
  }
  for (int i = 0; i < 1000; ++i) {
    command.translation().y() += 1e-4;
    const TrackerStatus status = tracker.step(command).status;
    if (i < 50) continue;  // the turn
    ASSERT_EQ(status, TrackerStatus::following) << i;
  }
}

TEST(TrackerClearance, MovesOutOfAClearance) {
  const TrackerAtWall at;
  Tracker free(at.arm, at.q);
  Pose command = at.home;
  command.translation().x() += 0.1;
  for (int i = 0; i < 3000; ++i) free.step(command);
  const Configuration start = free.configuration();
  const double within = excess_at(at.model, start);
  ASSERT_LT(within, -0.02);
  Tracker tracker(at.arm, start, {.model = &at.model});
  for (int i = 0; i < 3000; ++i) {
    tracker.step(at.home);
    ASSERT_GE(excess_at(at.model, tracker.configuration()), within - distance_rounding);
  }
  EXPECT_EQ(tracker.step(at.home).status, TrackerStatus::following);
}

TEST(TrackerClearance, ContinuesAfterAResetAsANewOne) {
  const TrackerAtWall at;
  Pose command = at.home;
  command.translation() += Vector3(0.3, 0.15, -0.1);  // behind the wall
  Tracker tracker(at.arm, at.q, {.model = &at.model});
  for (int i = 0; i < 1500; ++i) tracker.step(command);
  const Configuration start = tracker.configuration();
  tracker.reset(start);
  Tracker made(at.arm, start, {.model = &at.model});
  for (int i = 0; i < 500; ++i) {
    const Pose& aim = i < 250 ? at.home : command;
    ASSERT_EQ(tracker.step(aim).q, made.step(aim).q) << i;
  }
}

TEST(TrackerClearance, StepsNameTheBodies) {
  TrackerStep step;
  step.status = TrackerStatus::limited;
  step.limit = ServoLimit::clearance;
  step.bodies = BodyNames{"hand", "wall"};
  std::ostringstream text;
  text << step;
  EXPECT_EQ(text.str(), "limited, limit clearance of hand and wall, error 0 m, 0 rad");
  step.proved = false;
  text << step;
  EXPECT_NE(text.str().find("0 rad, not proved"), std::string::npos);
}

TEST(TrackerClearance, RefusesAnotherArm) {
  const TrackerAtWall at;
  EXPECT_REFUSED((Tracker(built_in("ur5e"), Configuration::Zero(6), {.model = &at.model})),
                 "another arm");
}

}  // namespace
}  // namespace beeline
