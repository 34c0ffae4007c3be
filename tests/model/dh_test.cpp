#include <cmath>
#include <gtest/gtest.h>

#include <beeline/model/arm.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using Matrix4 = Eigen::Matrix4d;

Matrix4 turn_x(double a) {
  const double c = std::cos(a), s = std::sin(a);
  return (Matrix4() << 1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1).finished();
}
Matrix4 turn_z(double a) {
  const double c = std::cos(a), s = std::sin(a);
  return (Matrix4() << c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1).finished();
}
Matrix4 slide(double x, double z) {
  Matrix4 matrix = Matrix4::Identity();
  matrix(0, 3) = x;
  matrix(2, 3) = z;
  return matrix;
}

DhRow random_row(testing::Random& random, JointKind kind) {
  return {.a = random.uniform(-1, 1),
          .alpha = random.uniform(-3, 3),
          .d = random.uniform(-1, 1),
          .theta = random.uniform(-3, 3),
          .kind = kind};
}

TEST(DhJoint, StandardIsAScrewAlongZThenAlongX) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const double q = random.uniform(-3, 3);
    DhRow row = random_row(random, JointKind::revolute);
    Matrix4 expected =
        turn_z(row.theta + q) * slide(0, row.d) * slide(row.a, 0) * turn_x(row.alpha);
    const Joint turning = dh_joint(row, DhConvention::standard);
    ASSERT_EQ(kind(turning), JointKind::revolute);
    ASSERT_LT((joint_transform(turning, q).matrix() - expected).norm(), 1e-14);
    row.kind = JointKind::prismatic;
    expected = turn_z(row.theta) * slide(0, row.d + q) * slide(row.a, 0) * turn_x(row.alpha);
    const Joint sliding = dh_joint(row, DhConvention::standard);
    ASSERT_EQ(kind(sliding), JointKind::prismatic);
    ASSERT_LT((joint_transform(sliding, q).matrix() - expected).norm(), 1e-14);
  }
}

TEST(DhJoint, ModifiedIsAScrewAlongXThenAlongZ) {
  testing::Random random;
  for (int i = 0; i < 2000; ++i) {
    const double q = random.uniform(-3, 3);
    DhRow row = random_row(random, JointKind::revolute);
    Matrix4 expected =
        slide(row.a, 0) * turn_x(row.alpha) * turn_z(row.theta + q) * slide(0, row.d);
    const Joint turning = dh_joint(row, DhConvention::modified);
    ASSERT_LT((joint_transform(turning, q).matrix() - expected).norm(), 1e-14);
    row.kind = JointKind::prismatic;
    expected = slide(row.a, 0) * turn_x(row.alpha) * turn_z(row.theta) * slide(0, row.d + q);
    const Joint sliding = dh_joint(row, DhConvention::modified);
    ASSERT_LT((joint_transform(sliding, q).matrix() - expected).norm(), 1e-14);
  }
}

TEST(DhJoint, RotatesAboutTheConventionsAxis) {
  const DhRow row{.a = 0.5, .alpha = 0.3, .d = 0.2, .theta = 0.1};
  Twist about_own_z = Twist::Zero();
  about_own_z[5] = 1;
  EXPECT_EQ(dh_joint(row, DhConvention::modified).screw, about_own_z);
  EXPECT_GT((dh_joint(row, DhConvention::standard).screw - about_own_z).norm(), 0.1)
      << "standard: joint i rotates about z of frame i-1";
}

TEST(DhJoint, RefusesHelicalRows) {
  EXPECT_REFUSED(dh_joint({.kind = JointKind::helical}, DhConvention::standard), "helical");
}

TEST(DhTable, MakesAnArmOfNamedJoints) {
  const std::vector<DhRow> rows{{.a = 0.4}, {.a = 0.3, .kind = JointKind::prismatic}};
  const std::vector<Limits> limits{{.lower = -1, .upper = 2}, {.lower = 0, .upper = 0.5}};
  for (const DhConvention convention : {DhConvention::standard, DhConvention::modified}) {
    const Arm arm = arm_from_dh("own", rows, convention, limits);
    EXPECT_EQ(arm.joint_names(), (std::vector<std::string>{"joint1", "joint2"}));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      EXPECT_EQ(arm.joints()[i].offset.matrix(), dh_joint(rows[i], convention).offset.matrix());
      EXPECT_EQ(arm.joints()[i].limits.upper, limits[i].upper);
    }
    EXPECT_EQ(arm_from_dh("own", rows, convention).limits(1).upper, Limits::none);
  }
  EXPECT_REFUSED(arm_from_dh("own", rows, DhConvention::standard, std::span(limits).first(1)),
                 "limits: 1 for 2 joints");
  EXPECT_REFUSED(arm_from_dh("own", {}, DhConvention::standard), "has no joints");
}

}  // namespace
}  // namespace beeline
