#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/trajectory/internal/continuous_joint.h>
#include <beeline/trajectory/trajectory.h>

#include <tests/random_arm.h>

namespace beeline {
namespace {

constexpr double revolution = 2 * std::numbers::pi;

Joint joint(const std::string& name, const Limits& limits) {
  Joint made;
  made.name = name;
  made.offset = make_pose({0.5, 0, 0});
  made.screw = rotation_screw({0, 0, 1});
  made.limits = limits;
  return made;
}

/// Two joints with a velocity limit of 3 rad/s, of which only the first is continuous.
Arm arm() { return {"two", {joint("a", {.velocity = 3}), joint("b", {-9, 9, 3})}}; }

/// A motion that is slower than 3 rad/s, of many revolutions.
Trajectory random_motion(testing::Random& random, bool rates) {
  Trajectory motion{{"a", "b"}, {}, {}, {}, {}};
  Configuration q = Eigen::Vector2d(random.uniform(-3, 3), 0), v = Eigen::Vector2d::Zero();
  double time = random.uniform(-1, 1);
  for (int k = random.integer(2, 400); k > 0; --k) {
    motion.times.push_back(time);
    motion.positions.push_back(q);
    if (rates) motion.velocities.push_back(v);
    const double step = random.uniform(0.01, 0.2);
    v = Eigen::Vector2d(random.uniform(-1, 2.9), 0);
    q += step * v;
    q[1] = random.uniform(-0.01, 0.01);
    time += step;
  }
  return motion;
}

/// The values of a sensor that wraps at `begin` and a revolution later.
Trajectory wrapped(Trajectory motion, double begin, int& wraps, double& first) {
  double before = 0;
  wraps = 0;
  for (std::size_t k = 0; k < motion.size(); ++k) {
    double& q = motion.positions[k][0];
    const double turns = std::floor((q - begin) / revolution);
    q -= turns * revolution;
    if (k > 0 && turns != before && wraps++ == 0) first = motion.times[k];
    before = turns;
  }
  return motion;
}

TEST(Unwrapped, IsTheMotionThatASensorWrapped) {
  testing::Random random;
  int with_wraps = 0;
  for (int i = 0; i < 300; ++i) {
    Trajectory motion = random_motion(random, i % 2 == 0);
    const double begin = i % 3 == 0 ? 0 : -std::numbers::pi;
    int wraps = 0;
    double first = 0;
    const Trajectory recorded = wrapped(motion, begin, wraps, first);
    const Unwrapped result = unwrapped(arm(), recorded);
    const double turns = recorded.positions[0][0] - motion.positions[0][0];
    for (std::size_t k = 0; k < motion.size(); ++k) {
      ASSERT_NEAR(result.trajectory.positions[k][0], motion.positions[k][0] + turns, 1e-9) << i;
      ASSERT_EQ(result.trajectory.positions[k][1], motion.positions[k][1]);
    }
    EXPECT_EQ(result.trajectory.velocities, motion.velocities);
    ASSERT_EQ(result.joints.size(), wraps > 0 ? 1u : 0u);
    if (wraps == 0) continue;
    ++with_wraps;
    EXPECT_EQ(result.joints[0].joint, "a");
    EXPECT_EQ(result.joints[0].wraps, wraps);
    EXPECT_EQ(result.joints[0].first_time, first);
  }
  EXPECT_GT(with_wraps, 100);
}

TEST(Unwrapped, LeavesJumpsThatKeepTheLimitOrCannotKeepIt) {
  const auto joints = [](const Arm& of, double step, double duration) {
    const Trajectory jump{of.joint_names(),
                          {0, duration},
                          {Configuration::Zero(of.dof()), Configuration::Constant(of.dof(), step)},
                          {},
                          {}};
    return unwrapped(of, jump).joints;
  };
  EXPECT_EQ(joints(arm(), 6, 0.5).size(), 1u);
  EXPECT_TRUE(joints(arm(), 6, 2.5).empty()) << "within the limit as it is";
  EXPECT_TRUE(joints(arm(), 3.5, 0.5).empty()) << "too fast in both directions";
  EXPECT_TRUE(joints(arm(), 3, 0.01).empty()) << "less than half a revolution";
  EXPECT_TRUE(joints(arm(), 19, 0.5).empty()) << "three revolutions";
  EXPECT_EQ(joints(arm(), 12.5, 0.5).size(), 1u) << "of a sensor of two revolutions";
  const Arm unknown("one", {joint("a", {})});
  EXPECT_EQ(joints(unknown, 6, 0.5).size(), 1u) << "by the assumed limit";
  EXPECT_TRUE(joints(with_speed_scale(unknown, 0.1), 6, 7).empty());
}

/// What --no-unwrap says of the default.
TEST(Unwrapped, TakesJumpsOfValuesWithinAsManyRevolutions) {
  const auto last = [](const std::vector<double>& values) {
    Trajectory recorded{{"a", "b"}, {}, {}, {}, {}};
    for (const double q : values) {
      recorded.times.push_back(0.1 * static_cast<double>(recorded.size()));
      recorded.positions.push_back(Eigen::Vector2d(q, 0));
    }
    return unwrapped(arm(), recorded).trajectory.positions.back()[0];
  };
  EXPECT_NEAR(last({0.5, 0.5 + revolution}), 0.5, 1e-12) << "exactly one, at rest";
  EXPECT_NEAR(last({-revolution, revolution}), -revolution, 1e-12) << "exactly two";
  EXPECT_NEAR(last({6.2, 6.28 - 2 * revolution}), 6.28, 1e-12) << "a sensor of two";
  EXPECT_NEAR(last({3.1, 3.1 - revolution, 3.1, 3.1 - revolution}), 3.1, 1e-12) << "in a row";
  EXPECT_NEAR(last({6.2, 6.2 - revolution, 6.2 - 2 * revolution}), 6.2 - 2 * revolution, 1e-12)
      << "jumps by one of values within two";
  EXPECT_NEAR(last({9.0, 3.1, 3.15 - revolution}), 3.15 - revolution, 1e-12)
      << "the first sample is outside of one revolution";
  EXPECT_NEAR(last({0.5, 0.5 + 3 * revolution}), 0.5 + 3 * revolution, 1e-12) << "three";
}

TEST(Unwrapped, FollowsAMotionThatIsFasterThanItsLimit) {
  Trajectory fast{{"a", "b"}, {}, {}, {}, {}};
  for (int k = 0; k < 200; ++k) {
    fast.times.push_back(0.01 * k);
    fast.positions.push_back(Eigen::Vector2d(std::remainder(0.05 * k, revolution), 0));
  }
  const Unwrapped result = unwrapped(arm(), fast);
  ASSERT_EQ(result.joints.size(), 1u);
  EXPECT_NEAR(result.trajectory.positions.back()[0], 0.05 * 199, 1e-9);
}

TEST(Unwrapped, LeavesValuesThatCountRevolutions) {
  Trajectory counted{{"a", "b"}, {0, 0.1, 0.2, 0.3}, {}, {}, {}};
  for (const double q : {9.0, 9.1, 9.2 - revolution, 9.3 - 2 * revolution}) {
    counted.positions.push_back(Eigen::Vector2d(q, 0));
  }
  EXPECT_TRUE(unwrapped(arm(), counted).joints.empty());
}

TEST(IsContinuous, IsAJointWhosePoseRepeats) {
  testing::Random random;
  const auto with_follower = [&](JointKind kind, double multiplier) {
    std::vector<Joint> joints{joint("a", {}), testing::random_joint(random, kind, "b")};
    joints[1].limits = {};
    joints[1].mimic = Mimic{"a", multiplier, 0.1};
    return Arm("pair", joints);
  };
  const auto check = [&](const Arm& of, bool expected) {
    EXPECT_EQ(internal::is_continuous(of, 0), expected);
    Configuration q = Configuration::Constant(1, 0.3);
    const Pose before = forward_kinematics(of, q);
    q[0] += revolution;
    const bool repeats = before.isApprox(forward_kinematics(of, q), 1e-9);
    EXPECT_EQ(repeats, expected);
  };
  check(Arm("one", {joint("a", {})}), true);
  check(with_follower(JointKind::revolute, -2), true);
  check(with_follower(JointKind::revolute, 0.5), false);
  check(with_follower(JointKind::prismatic, 1), false);
  check(with_follower(JointKind::helical, 1), false);
  EXPECT_FALSE(internal::is_continuous(arm(), 1));
  EXPECT_FALSE(internal::is_continuous(Arm("one", {joint("a", {.lower = -9})}), 0));
}

TEST(Difference, OfAContinuousJointCountsNoWholeRevolutions) {
  testing::Random random;
  const Trajectory a = random_motion(random, false);
  Trajectory b = a;
  for (Configuration& q : b.positions) q[0] += 3 * revolution + 0.01;
  const TrajectoryDifference found = difference(arm(), a, b);
  EXPECT_NEAR(found.joints[0].largest, 0.01, 1e-9);
  EXPECT_EQ(found.joints[1].largest, 0);
}

}  // namespace
}  // namespace beeline
