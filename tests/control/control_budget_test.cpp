#include <gtest/gtest.h>

#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/control/replay.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/timing/point_to_point.h>

#include "../ended_budget.h"

namespace beeline {
namespace {

template <class Run>
void expect_parts(Run&& run) {
  const ControlledMotion whole = run(Budget{});
  ASSERT_TRUE(whole) << whole.reason;
  std::size_t steps = 0;
  testing::for_each_cancellation(1000, [&](int n) {
    SCOPED_TRACE("cancelled at question " + std::to_string(n));
    testing::CancelAt cancel(n);
    const ControlledMotion part = run(cancel.budget());
    EXPECT_EQ(part.status, cancel.cancelled() ? MotionStatus::cancelled : MotionStatus::reached);
    const auto& q = part.trajectory.positions;
    EXPECT_GE(q.size(), std::max<std::size_t>(steps, 1));
    EXPECT_LE(q.size(), whole.trajectory.size());
    EXPECT_TRUE(std::equal(q.begin(), q.end(), whole.trajectory.positions.begin()));
    steps = q.size();
    return cancel.cancelled() && !::testing::Test::HasFailure();
  });
  EXPECT_EQ(steps, whole.trajectory.size());
}

TEST(ControlBudget, AMotionIsThatUpToThere) {
  const Arm arm = built_in("rrr");
  const Configuration from{{0.3, 1.2, 0.4}}, to{{1, 0.5, -0.3}};
  expect_parts([&](const Budget& budget) {
    return control_joints(arm, from, to, {.kp = 0.1}, {.budget = budget});
  });
  std::vector<Pose> waypoints{forward_kinematics(arm, to), forward_kinematics(arm, from)};
  for (const CartesianMethod method :
       {CartesianMethod::inverse_jacobian, CartesianMethod::inverse_kinematics}) {
    expect_parts([&](const Budget& budget) {
      return control_in_lines(arm, from, waypoints,
                              {.method = method, .gain = 0.3, .simulation = {.budget = budget}});
    });
  }
}

TEST(ControlBudget, AReplayIsTheWholeOrNone) {
  const Arm arm = built_in("panda");
  const Configuration q = middle_configuration(arm);
  const Trajectory recording = sampled(arm, point_to_point(arm, q, q.array() + 0.3), 100);
  ReplayOptions steady{.rate = 333, .start = q.array() - 0.1}, changing{.rate = 200};
  changing.speed_at = {{0, 0.5}, {0.2, 1}};
  for (ReplayOptions options : {steady, changing}) {
    const Replay whole = replay(arm, recording, options);
    ASSERT_TRUE(whole) << whole.reason;
    int ended = 0;
    testing::for_each_cancellation(1000, [&](int n) {
      SCOPED_TRACE("cancelled at question " + std::to_string(n));
      testing::CancelAt cancel(n);
      options.budget = cancel.budget();
      const Replay part = replay(arm, recording, options);
      EXPECT_EQ(part.status, cancel.cancelled() ? MotionStatus::cancelled : MotionStatus::reached);
      EXPECT_EQ(part.trajectory.positions,
                cancel.cancelled() ? std::vector<Configuration>() : whole.trajectory.positions);
      EXPECT_EQ(!part.reason, !cancel.cancelled());
      ended += cancel.cancelled() ? 1 : 0;
      return cancel.cancelled() && !::testing::Test::HasFailure();
    });
    EXPECT_GT(ended, 2);
  }
}

}  // namespace
}  // namespace beeline
