#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <sstream>

#include <beeline/pose/se3.h>
#include <beeline/pose/so3.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using std::numbers::pi;

Rotation about_x(double a) {
  return (Rotation() << 1, 0, 0, 0, std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a))
      .finished();
}
Rotation about_y(double a) {
  return (Rotation() << std::cos(a), 0, std::sin(a), 0, 1, 0, -std::sin(a), 0, std::cos(a))
      .finished();
}
Rotation about_z(double a) {
  return (Rotation() << std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1)
      .finished();
}

TEST(RollPitchYaw, RotatesAboutTheFixedAxesXThenYThenZ) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const RollPitchYaw rpy{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)};
    const Rotation expected = about_z(rpy.yaw) * about_y(rpy.pitch) * about_x(rpy.roll);
    ASSERT_LT((rotation(rpy) - expected).norm(), 6e-15);
  }
}

TEST(RollPitchYaw, ReadsBackTheAnglesAndTheRotation) {
  testing::Random random;
  for (int i = 0; i < 10000; ++i) {
    const RollPitchYaw rpy{random.uniform(-pi, pi), random.uniform(-1.5, 1.5),
                           random.uniform(-pi, pi)};
    const RollPitchYaw back = roll_pitch_yaw(rotation(rpy));
    ASSERT_NEAR(angle_difference(back.roll, rpy.roll), 0, 6e-14);
    ASSERT_NEAR(back.pitch, rpy.pitch, 6e-14);
    ASSERT_NEAR(angle_difference(back.yaw, rpy.yaw), 0, 6e-14);
    const Rotation any = random.rotation();
    ASSERT_LT((rotation(roll_pitch_yaw(any)) - any).norm(), 9e-15);
  }
}

TEST(RollPitchYaw, KeepsItsDigitsNearGimbalLock) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const double off = std::pow(10, random.uniform(-17, -1));
    const double up = random.integer(0, 1) == 0 ? 1 : -1;
    const Rotation r = about_z(random.uniform(-pi, pi)) * about_y(up * (pi / 2 - off)) *
                       about_x(random.uniform(-pi, pi));
    const RollPitchYaw rpy = roll_pitch_yaw(r);
    ASSERT_LE(std::abs(rpy.pitch), pi / 2);
    ASSERT_LT((rotation(rpy) - r).norm(), 4e-12) << off;
  }
}

TEST(RollPitchYaw, HasZeroRollInGimbalLock) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const double roll = random.uniform(-pi, pi), yaw = random.uniform(-pi, pi);
    const RollPitchYaw up = roll_pitch_yaw(rotation({roll, pi / 2, yaw}));
    ASSERT_EQ(up.roll, 0);
    ASSERT_NEAR(up.pitch, pi / 2, 3e-15);
    ASSERT_NEAR(angle_difference(up.yaw, yaw - roll), 0, 6e-15);
    const RollPitchYaw down = roll_pitch_yaw(rotation({roll, -pi / 2, yaw}));
    ASSERT_EQ(down.roll, 0);
    ASSERT_NEAR(down.pitch, -pi / 2, 3e-15);
    ASSERT_NEAR(angle_difference(down.yaw, yaw + roll), 0, 6e-15);
  }
}

TEST(Quaternion, ReadsBackWithUnitLengthAndPositiveW) {
  testing::Random random;
  for (int i = 0; i < 10000; ++i) {
    Rotation r = random.rotation();
    if (i % 4 == 0) {  // rotations by pi, where w is 0
      const Vector3 a = random.direction();
      r = 2 * a * a.transpose() - Rotation::Identity();
    }
    const Quaternion q = quaternion(r);
    ASSERT_GE(q.qw, 0);
    ASSERT_NEAR(q.qw * q.qw + q.qx * q.qx + q.qy * q.qy + q.qz * q.qz, 1, 3e-15);
    ASSERT_LT((rotation_from_quaternion(q.qw, q.qx, q.qy, q.qz) - r).norm(), 9e-15);
    ASSERT_LT((rotation_from_quaternion(-q.qw, -q.qx, -q.qy, -q.qz) - r).norm(), 9e-15)
        << "q and -q are the same rotation";
  }
}

TEST(Quaternion, HasItsNamedFieldsInOrder) {
  const double c = std::cos(0.3), s = std::sin(0.3);
  EXPECT_LT((rotation_from_quaternion(c, s, 0, 0) - about_x(0.6)).norm(), 1e-15);
  EXPECT_LT((rotation_from_quaternion(c, 0, s, 0) - about_y(0.6)).norm(), 1e-15);
  EXPECT_LT((rotation_from_quaternion(c, 0, 0, s) - about_z(0.6)).norm(), 1e-15);
}

TEST(Quaternion, OfAlmostUnitLengthIsNormalisedAndAnyOtherRefused) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Quaternion q = quaternion(random.rotation());
    const double scale = random.uniform(0.9991, 1.0009);
    const Rotation r =
        rotation_from_quaternion(scale * q.qw, scale * q.qx, scale * q.qy, scale * q.qz);
    ASSERT_LT((r * r.transpose() - Rotation::Identity()).norm(), 1e-14);
    const double bad =
        random.integer(0, 1) == 0 ? random.uniform(0, 0.998) : random.uniform(1.002, 9);
    ASSERT_THROW(rotation_from_quaternion(bad * q.qw, bad * q.qx, bad * q.qy, bad * q.qz), Error);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_REFUSED(rotation_from_quaternion(0, 0, 0, 0), "qw,qx,qy,qz = 0,0,0,0 has length 0");
  EXPECT_REFUSED(rotation_from_quaternion(1, 1, 0, 0), "1.41421");
  EXPECT_REFUSED(rotation_from_quaternion(nan, 0, 0, 0), "nan");
  EXPECT_REFUSED(rotation_from_quaternion(1, inf, 0, 0), "inf");
}

TEST(MakePose, PutsThePartsWhereTheyBelong) {
  const Pose pose = make_pose({1, 2, 3}, about_z(0.5));
  EXPECT_EQ(pose.translation(), Vector3(1, 2, 3));
  EXPECT_EQ(pose.linear(), about_z(0.5));
  EXPECT_EQ(pose.matrix().row(3), Eigen::RowVector4d(0, 0, 0, 1));
  EXPECT_EQ(make_pose({1, 2, 3}).linear(), Rotation::Identity());
}

TEST(Pose, PrintsPositionAndRollPitchYaw) {
  std::ostringstream out;
  out << make_pose({0.3, -0.25, 1e-17}, rotation(RollPitchYaw{0, 1.25, -0.5}));
  EXPECT_EQ(out.str(), "x 0.3, y -0.25, z 0 m, roll 0, pitch 1.25, yaw -0.5 rad");
}

}  // namespace
}  // namespace beeline
