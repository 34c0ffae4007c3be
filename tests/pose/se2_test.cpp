#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/pose/se2.h>
#include <beeline/pose/so3.h>

#include <tests/random.h>

namespace beeline {
namespace {

using std::numbers::pi;

Pose2 random_pose(testing::Random& random) {
  return {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-pi, pi)};
}

void expect_same(const Pose2& a, const Pose2& b, double tolerance) {
  ASSERT_NEAR(a.x, b.x, tolerance);
  ASSERT_NEAR(a.y, b.y, tolerance);
  ASSERT_NEAR(angle_difference(a.theta, b.theta), 0, tolerance);
}

Twist in_space(const Twist2& twist) {
  Twist spatial;
  spatial << twist.x(), twist.y(), 0, 0, 0, twist.z();
  return spatial;
}

Twist2 any_planar_twist(testing::Random& random) {
  const double size = std::min(std::pow(10, random.uniform(-12, 0.5)), pi - 1e-9);
  const double far = pi - std::pow(10, random.uniform(-9, 0));
  const double sign = random.integer(0, 1) == 0 ? -1 : 1;
  return {random.uniform(-3, 3), random.uniform(-3, 3),
          sign * (random.integer(0, 1) == 0 ? size : far)};
}

TEST(Se2, IsAGroup) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const Pose2 a = random_pose(random), b = random_pose(random), c = random_pose(random);
    expect_same((a * b) * c, a * (b * c), 3e-14);
    expect_same(a * inverse(a), {}, 3e-14);
    expect_same(inverse(a) * a, {}, 3e-14);
    expect_same(a * Pose2{}, a, 0);
    ASSERT_LE(std::abs((a * b).theta), pi);
    ASSERT_LE(std::abs(inverse(a).theta), pi);
  }
}

TEST(Se2, IsASubgroupOfSe3) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const Pose2 a = random_pose(random), b = random_pose(random);
    const Pose product = to_space(a) * to_space(b);
    ASSERT_LT((to_space(a * b).matrix() - product.matrix()).norm(), 3e-14);
    expect_same(to_plane(to_space(a, random.uniform(-1, 1))), a, 3e-15);
    const Twist2 twist = any_planar_twist(random);
    ASSERT_LT((to_space(se2_exp(twist)).matrix() - se3_exp(in_space(twist)).matrix()).norm(),
              2e-14);
  }
}

TEST(ToSpace, IsInThePlaneOfItsHeight) {
  const Pose pose = to_space({1, 2, pi / 2}, 0.7);
  EXPECT_EQ(pose.translation(), Vector3(1, 2, 0.7));
  EXPECT_EQ(pose.linear().col(2), Vector3::UnitZ());
  EXPECT_LT((pose.linear() * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-16);
}

TEST(Se2Exp, EqualsItsPowerSeriesInExtendedPrecision) {
  testing::Random random;
  using LongMatrix = Eigen::Matrix<long double, 3, 3>;
  for (int i = 0; i < 3000; ++i) {
    const Twist2 twist = any_planar_twist(random);
    LongMatrix xi;
    xi << 0, -twist.z(), twist.x(), twist.z(), 0, twist.y(), 0, 0, 0;
    LongMatrix term = LongMatrix::Identity(), sum = term;
    for (int k = 1; k < 60; ++k) {
      term = term * xi / k;
      sum += term;
    }
    const Pose2 pose = se2_exp(twist);
    ASSERT_NEAR(pose.x, static_cast<double>(sum(0, 2)), 9e-15) << twist.transpose();
    ASSERT_NEAR(pose.y, static_cast<double>(sum(1, 2)), 9e-15) << twist.transpose();
    ASSERT_EQ(pose.theta, twist.z());
  }
}

TEST(Se2Log, IsTheInverseOfExpUpToAlmostPi) {
  testing::Random random;
  for (int i = 0; i < 10000; ++i) {
    const Twist2 twist = any_planar_twist(random);
    const Twist2 back = se2_log(se2_exp(twist));
    ASSERT_LT((back - twist).head<2>().norm(), 3e-14) << twist.transpose();
    ASSERT_EQ(back.z(), twist.z());
  }
}

TEST(Se2Log, IsInvertedByExpAlsoAtExactlyPiAndBeyond) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    Pose2 pose = random_pose(random);
    if (i % 3 == 0) pose.theta = i % 2 == 0 ? pi : -pi;
    if (i % 3 == 1) pose.theta = random.uniform(-30, 30);
    const Twist2 twist = se2_log(pose);
    ASSERT_LE(std::abs(twist.z()), pi);
    expect_same(se2_exp(twist), pose, 6e-14);
  }
}

TEST(PoseDifferenceInThePlane, IsTheChaptersErrorWithTheSmallestAngle) {
  const Twist2 error = pose_difference({4.5, 5.2, pi - 0.1}, {1, 2, -pi + 0.1});
  EXPECT_NEAR(error.x(), 3.5, 1e-15);
  EXPECT_NEAR(error.y(), 3.2, 1e-15);
  EXPECT_NEAR(error.z(), -0.2, 1e-15);
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const Pose2 to = random_pose(random), from = random_pose(random);
    const Twist spatial = pose_difference(to_space(to), to_space(from));
    const Twist2 planar = pose_difference(to, from);
    if (std::abs(planar.z()) > pi - 1e-6) continue;  // there the sign is arbitrary
    ASSERT_LT((spatial - in_space(planar)).norm(), 3e-14);
  }
}

}  // namespace
}  // namespace beeline
