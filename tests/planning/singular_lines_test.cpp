#include <gtest/gtest.h>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

namespace beeline {
namespace {

// Both ends of the line are singular, so that no end determines the branch.
TEST(SingularLines, BetweenTwoSingularPosesAreFound) {
  const Arm arm = built_in("puma560");
  const Configuration wrist{{0.2, 0.6, -0.9, 0.4, 0, 0.3}};
  const Pose from = forward_kinematics(arm, wrist);
  Pose to = from;
  to.translation() += Vector3(0.05, 0.04, -0.06);
  // The wrist is singular again where the tool's axis is parallel to the forearm's.
  const PathMotion there = move_in_lines(arm, {from, to});
  ASSERT_TRUE(there) << there.reason;
  Configuration end = there.trajectory.positions.back();
  end[4] = 0;
  const Pose singular = forward_kinematics(arm, end);
  const PathMotion motion = move_in_lines(arm, {from, singular});
  EXPECT_TRUE(motion) << motion.reason;
  const PathMotion again = move_in_lines(arm, {from, singular, from, singular});
  EXPECT_TRUE(again) << again.reason;
}

}  // namespace
}  // namespace beeline
