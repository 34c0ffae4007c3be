#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include <beeline/model/joint.h>

#include <tests/random_arm.h>
#include <tests/refusal.h>
#include <unsupported/Eigen/MatrixFunctions>

namespace beeline {
namespace {

using std::numbers::pi;
constexpr JointKind kinds[] = {JointKind::revolute, JointKind::prismatic, JointKind::helical};

TEST(ScrewMotion, IsTheMatrixExponentialForEveryKindAndPlace) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const Twist screw = testing::random_joint(random, kinds[i % 3], "j").screw;
    const double q = i < 100 ? std::pow(10, -i / 8.0) : random.uniform(-7, 7);
    Eigen::Matrix4d xi = Eigen::Matrix4d::Zero();
    xi.topLeftCorner<3, 3>() = hat(screw.tail<3>());
    xi.topRightCorner<3, 1>() = screw.head<3>();
    const Eigen::Matrix4d exact = Eigen::Matrix4d(xi * q).exp();
    ASSERT_LT((screw_motion(screw, q).matrix() - exact).norm(), 9e-14) << q;
    ASSERT_LT((se3_exp(screw * q).matrix() - exact).norm(), 9e-14) << q;
  }
}

TEST(ScrewMotion, KeepsTheAxisAndTranslatesByThePitch) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const Vector3 axis = random.direction(), point = random.vector(2);
    const double pitch = random.uniform(-1, 1), q = random.uniform(-10, 10);
    const Pose motion = screw_motion(rotation_screw(axis, point, pitch), q);
    const Vector3 on_axis = point + random.uniform(-2, 2) * axis;
    ASSERT_LT((motion * on_axis - (on_axis + pitch * q * axis)).norm(), 9e-14);
    const Pose turn = screw_motion(rotation_screw(axis, point), q);
    ASSERT_LT((turn * on_axis - on_axis).norm(), 6e-14);
    const Vector3 off = random.vector(2);
    ASSERT_NEAR((turn * off - point).norm(), (off - point).norm(), 6e-14);
    const Pose slide = screw_motion(translation_screw(3 * axis), q);
    ASSERT_LT((slide * off - (off + q * axis)).norm(), 3e-14);
    ASSERT_EQ(slide.linear(), Rotation::Identity());
  }
}

TEST(ScrewMotion, AtZeroIsExactlyTheIdentity) {
  testing::Random random;
  for (int i = 0; i < 300; ++i) {
    const Joint joint = testing::random_joint(random, kinds[i % 3], "j");
    ASSERT_EQ(screw_motion(joint.screw, 0).matrix(), Pose::Identity().matrix());
  }
}

TEST(Kind, FollowsFromTheScrewForAnyAxis) {
  testing::Random random;
  for (int i = 0; i < 20000; ++i) {
    const double far = std::pow(10, random.uniform(-2, 4));
    Joint joint;
    joint.screw = rotation_screw(random.direction() * random.uniform(0.1, 5), random.vector(far));
    ASSERT_EQ(kind(joint), JointKind::revolute) << joint.screw.transpose();
    ASSERT_EQ(pitch(joint), 0) << "rounding does not count as pitch";
    ASSERT_EQ(kind(with_link_frame(joint, random.pose(far))), JointKind::revolute);
    joint.screw = translation_screw(random.direction());
    ASSERT_EQ(kind(joint), JointKind::prismatic);
    ASSERT_EQ(pitch(joint), 0);
    ASSERT_EQ(kind(with_link_frame(joint, random.pose(far))), JointKind::prismatic);
    const double travel = random.uniform(0.001, 1);
    joint.screw = rotation_screw(random.direction(), random.vector(), -travel);
    ASSERT_EQ(kind(joint), JointKind::helical);
    ASSERT_NEAR(pitch(joint), -travel, 3e-15);
    ASSERT_NEAR(pitch(with_link_frame(joint, random.pose())), -travel, 3e-14);
  }
}

TEST(Kind, HasTheChaptersLetterAndAName) {
  EXPECT_EQ(letter(JointKind::revolute), 'R');
  EXPECT_EQ(letter(JointKind::prismatic), 'P');
  EXPECT_EQ(letter(JointKind::helical), 'H');
  EXPECT_EQ(name(JointKind::revolute), "revolute");
  EXPECT_EQ(name(JointKind::prismatic), "prismatic");
  EXPECT_EQ(name(JointKind::helical), "helical");
}

TEST(Screws, AreUnitForAnAxisOfAnyLengthAndRefuseZero) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Vector3 axis = random.direction() * std::pow(10, random.uniform(-8, 300));
    ASSERT_NEAR(rotation_screw(axis, random.vector()).tail<3>().norm(), 1, 3e-15);
    ASSERT_NEAR(translation_screw(axis).head<3>().norm(), 1, 3e-15);
    ASSERT_LT(rotation_screw(axis).tail<3>().cross(axis.stableNormalized()).norm(), 3e-15);
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_REFUSED(rotation_screw(Vector3::Zero()), "axis 0 0 0 has no direction");
  EXPECT_REFUSED(translation_screw(Vector3::Zero()), "axis 0 0 0 has no direction");
  EXPECT_REFUSED(rotation_screw({nan, 0, 1}), "axis nan 0 1");
  EXPECT_REFUSED(translation_screw({0, inf, 1}), "axis 0 inf 1");
}

TEST(JointTransform, IsTheOffsetAndThenTheMotion) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Joint joint = testing::random_joint(random, kinds[i % 3], "j");
    ASSERT_EQ(joint_transform(joint, 0).matrix(), joint.offset.matrix());
    const double q = random.uniform(-3, 3);
    ASSERT_EQ(joint_transform(joint, q).matrix(),
              (joint.offset * screw_motion(joint.screw, q)).matrix());
  }
}

TEST(WithLinkFrame, IsTheSameMotionInAnotherFrameOfTheLink) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    Joint joint = testing::random_joint(random, kinds[i % 3], "elbow");
    joint.limits.velocity = 2;
    joint.link = "forearm";
    const Pose link_T_frame = random.pose(2);
    const Joint moved = with_link_frame(joint, link_T_frame);
    const double q = random.uniform(-2 * pi, 2 * pi);
    const Pose expected = joint_transform(joint, q) * link_T_frame;
    ASSERT_LT((joint_transform(moved, q).matrix() - expected.matrix()).norm(), 9e-14);
    ASSERT_EQ(kind(moved), kind(joint));
    ASSERT_EQ(moved.name, "elbow");
    ASSERT_EQ(moved.link, "forearm");
    ASSERT_EQ(moved.limits.velocity, 2);
    const Joint back = with_link_frame(moved, link_T_frame.inverse());
    ASSERT_LT((back.screw - joint.screw).norm(), 3e-14);
  }
}

}  // namespace
}  // namespace beeline
