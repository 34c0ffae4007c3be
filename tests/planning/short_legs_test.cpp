#include <gtest/gtest.h>

#include <beeline/certificate/verify.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>
#include <beeline/pose/so3.h>

#include <tests/random.h>
#include <tests/reason.h>

namespace beeline {
namespace {

Pose shifted(const Pose& pose, const Vector3& by) {
  Pose moved = pose;
  moved.translation() += by;
  return moved;
}

/// A configuration in the middle of the arm's ranges, where lines are possible.
Configuration near_middle(testing::Random& random, const Arm& arm) {
  const Configuration middle = middle_configuration(arm);
  return middle + 0.5 * (random.configuration(arm) - middle);
}

// The velocity of linear joints changes at a stop within the shorter of its two intervals, which a
// short leg beside a long one makes very short.
TEST(MoveInLines, PassesShortLegsWithLinearJoints) {
  testing::Random random;
  int reached = 0, legs = 0, over_jerk = 0;
  for (int i = 0; i < testing::cases(30); ++i) {
    const Arm arm = built_in(i % 3 == 0 ? "ur5" : i % 3 == 1 ? "panda" : "puma560");
    const Configuration start = near_middle(random, arm);
    const Pose from = forward_kinematics(arm, start);
    const Configuration other = random.configuration(arm) - middle_configuration(arm);
    const Pose to = forward_kinematics(arm, Configuration(start + 0.1 * other.normalized()));
    const PathMotionOptions options{
        .profile = i % 2 == 0 ? std::optional<Profile>{} : Profile::trapezoidal,
        .interpolation = Interpolation::linear};
    if (!move_in_lines(arm, start, {to}, options)) continue;
    ++reached;
    for (const double length : {1e-8, 1e-6, 1e-5, 1e-4, 1e-3}) {
      const Pose near = shifted(from, length * random.direction());
      const Pose beside = shifted(to, near.translation() - from.translation());
      for (const auto& poses : {std::vector{near, to}, std::vector{to, beside}}) {
        const PathMotion motion = move_in_lines(arm, start, poses, options);
        ++legs;
        // A trapezoidal profile stops and starts with its largest acceleration, which in intervals
        // of 1e-5 s may need more than the jerk limit.
        const bool jerks =
            options.profile && motion.reason.code == ReasonCode::derivative_needed &&
            testing::field<std::string>(motion.reason, ReasonField::quantity) == "jerk";
        over_jerk += jerks;
        EXPECT_TRUE(motion || jerks) << arm.name() << ", " << length << " m: " << motion.reason;
      }
    }
  }
  EXPECT_LE(over_jerk, 1 + legs / 30) << "of " << legs;
  EXPECT_GT(2 * reached, testing::cases(30));
}

// Near a wrist singularity the second line is short for its rotation: the point of it that is
// nearest to the start has another orientation.
TEST(MoveInLines, BeginsWithALegAsShortAsRounding) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  const Configuration start{{1.3624613963882082, -2.048212829269267, 2.003807898245432,
                             2.63881113995941, 0.25331409620910517, 1.3018757740159081}};
  const Pose from = forward_kinematics(arm, start);
  for (int i = 0; i < testing::cases(100); ++i) {
    const Pose near = shifted(from, std::pow(10, random.uniform(-9.7, -8.5)) * random.direction());
    const Pose to = make_pose(from.translation() + 0.01 * random.direction(),
                              so3_exp(0.5 * random.direction()) * from.linear());
    PathMotion motion;
    ASSERT_NO_THROW(motion = move_in_lines(arm, start, {near, to}));
    EXPECT_EQ(motion.status, move_in_lines(arm, start, {to}).status) << motion.reason;
  }
}

// Each of these legs counts as standing still; together they lead away.
TEST(MoveInLines, FollowsManyLegsAsShortAsRounding) {
  const Arm arm = built_in("ur5");
  const Configuration start{{0.5, -1, 1.5, -0.5, 1, 0}};
  const Pose from = forward_kinematics(arm, start);
  std::vector<Pose> waypoints;
  for (int i = 1; i <= 50; ++i) waypoints.push_back(shifted(from, {0, 0, 0.9e-9 * i}));
  waypoints.push_back(shifted(from, {0, 0, 0.05}));
  const PathMotion motion = move_in_lines(arm, start, waypoints);
  EXPECT_TRUE(motion) << motion.reason;
  ASSERT_EQ(motion.arrivals.size(), waypoints.size());
}

}  // namespace
}  // namespace beeline
