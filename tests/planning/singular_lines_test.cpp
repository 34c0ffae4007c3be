#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

#include <tests/random.h>
#include <tests/reason.h>

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

/// A refusal at a singular start says so and names the joint; at another start it does not.
TEST(SingularLines, FromASingularStartAreRefusedWithItsJoint) {
  testing::Random random;
  int singular = 0, named = 0;
  for (const char* name : {"puma560", "ur5"}) {
    const Arm arm = built_in(name);
    for (int i = 0; i < testing::cases(60); ++i) {
      Configuration start = random.configuration(arm);
      const bool stretched = i % 2 == 0;
      start[4] = stretched ? random.uniform(-1e-9, 1e-9) : random.uniform(0.5, 1);
      const Pose from = forward_kinematics(arm, start);
      Pose to = from;
      to.translation() +=
          Vector3(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1));
      const PathMotion motion = move_in_lines(arm, start, {to});
      if (motion) continue;
      const bool at_start = motion.reason.code == ReasonCode::singular_at_start;
      const bool joint = testing::joint(motion.reason) == "joint5";
      EXPECT_FALSE(at_start && !stretched) << motion.reason;
      if (stretched && motion.status == MotionStatus::singular) {
        ++singular;
        EXPECT_TRUE(at_start || motion.path_parameter > 1e-3) << motion.reason;
      }
      if (at_start) named += joint ? 1 : 0;
      EXPECT_TRUE(motion.reason.code != ReasonCode::spline_outside_limits ||
                  motion.reason.has(ReasonField::planned));
    }
  }
  EXPECT_GT(singular, 0);
  EXPECT_GE(named, singular - 2);
}

/// The elbow bends continuously from stretched, as the square root of the path length, also where
/// the tool turns quickly on a short line: no tolerance makes this a jump of the joints.
TEST(SingularLines, FromAStretchedElbowTheJointsDoNotJump) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  int moved = 0, refused = 0;
  for (int i = 0; i < testing::cases(40); ++i) {
    const double wrist = random.uniform(0.3, 2.5) * (i % 2 == 0 ? 1 : -1);
    const Configuration start{{random.uniform(-3, 3), 0, wrist}};
    const double angle = start[0] + wrist - std::copysign(random.uniform(0.2, 0.8), wrist);
    Pose to = forward_kinematics(arm, start);
    to.translation() += Vector3(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), 0);
    to.linear() = Eigen::AngleAxisd(angle, Vector3::UnitZ()).toRotationMatrix();
    constexpr double length = 2;  // of the last link
    if ((to * Vector3(-length, 0, 0)).norm() > 6.95) continue;
    const double tolerance = std::pow(10, random.uniform(-8, -6));
    const PathMotion motion = move_in_lines(arm, start, {to}, {.tolerance = tolerance});
    moved += motion ? 1 : 0;
    refused += motion ? 0 : 1;
    EXPECT_NE(motion.status, MotionStatus::singular) << motion.reason << " at " << tolerance;
  }
  EXPECT_GT(moved, 0);
  EXPECT_LE(10 * refused, moved);
}

}  // namespace
}  // namespace beeline
