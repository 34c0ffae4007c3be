#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/pose/se3.h>

#include <tests/random.h>

namespace beeline {
namespace {

using std::numbers::pi;
using Matrix4 = Eigen::Matrix4d;
using LongMatrix4 = Eigen::Matrix<long double, 4, 4>;

/// exp as its power series, in extended precision.
Matrix4 exp_series(const Twist& twist) {
  LongMatrix4 xi = LongMatrix4::Zero();
  xi.topLeftCorner<3, 3>() = hat(twist.tail<3>()).cast<long double>();
  xi.topRightCorner<3, 1>() = twist.head<3>().cast<long double>();
  LongMatrix4 term = LongMatrix4::Identity(), sum = term;
  for (int k = 1; k < 60; ++k) {
    term = term * xi / k;
    sum += term;
  }
  return sum.cast<double>();
}

Twist any_twist(testing::Random& random) {
  const double size = std::min(std::pow(10, random.uniform(-12, 0.5)), pi - 1e-9);
  const double far = pi - std::pow(10, random.uniform(-9, 0));
  Twist twist;
  twist << random.vector(3), random.direction() * (random.integer(0, 1) == 0 ? size : far);
  return twist;
}

double distance(const Pose& a, const Pose& b) { return (a.matrix() - b.matrix()).norm(); }

TEST(Se3, IsAGroup) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const Pose a = se3_exp(any_twist(random)), b = random.pose(), c = random.pose();
    ASSERT_LT(distance((a * b) * c, a * (b * c)), 6e-14);
    ASSERT_LT(distance(a * a.inverse(), Pose::Identity()), 3e-14);
    ASSERT_EQ(distance(a * Pose::Identity(), a), 0);
    ASSERT_NEAR(a.linear().determinant(), 1, 9e-15);
  }
}

TEST(Se3Exp, EqualsItsPowerSeriesInExtendedPrecision) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    Twist twist = any_twist(random);
    if (i % 3 == 0) {  // around the switch between series and quotient
      twist.tail<3>() *= random.uniform(0.09, 0.11) / twist.tail<3>().norm();
    }
    ASSERT_LT((se3_exp(twist).matrix() - exp_series(twist)).norm(), 2e-14) << twist.transpose();
  }
}

TEST(Se3Exp, AddsAlongOneTwistAndTranslatesStraightWithoutRotation) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const Twist twist = any_twist(random);
    const double s = random.uniform(-2, 2), t = random.uniform(-2, 2);
    ASSERT_LT(distance(se3_exp(s * twist) * se3_exp(t * twist), se3_exp((s + t) * twist)), 3e-13);
    ASSERT_LT(distance(se3_exp(-twist), se3_exp(twist).inverse()), 3e-14);
    Twist slide = twist;
    slide.tail<3>().setZero();
    ASSERT_EQ(se3_exp(slide).translation(), slide.head<3>());
    ASSERT_EQ(se3_log(se3_exp(slide)), slide);
  }
}

TEST(Se3Log, IsTheInverseOfExpUpToAlmostPi) {
  testing::Random random;
  for (int i = 0; i < 10000; ++i) {
    const Twist twist = any_twist(random);
    const Twist back = se3_log(se3_exp(twist));
    ASSERT_LT((back - twist).head<3>().norm(), 2e-13) << twist.transpose();
    ASSERT_LT((back - twist).tail<3>().norm(), 1e-14 * twist.tail<3>().norm()) << twist.transpose();
  }
}

TEST(Se3Log, KeepsItsDigitsBetweenSeriesAndQuotient) {
  testing::Random random;
  for (int i = 0; i < 10000; ++i) {
    Twist twist;
    twist << 3 * random.direction(), random.direction() * random.uniform(0.08, 0.12);
    ASSERT_LT((se3_log(se3_exp(twist)) - twist).norm(), 4e-15) << twist.tail<3>().norm();
  }
}

TEST(Se3Log, IsInvertedByExpAlsoAtExactlyPi) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    Pose pose = random.pose(5);
    if (i % 2 == 0) {
      const Vector3 a = random.direction();
      pose.linear() = 2 * a * a.transpose() - Rotation::Identity();
    }
    const Twist twist = se3_log(pose);
    ASSERT_LE(twist.tail<3>().norm(), pi + 4e-15);
    ASSERT_LT(distance(se3_exp(twist), pose), 2e-13);
  }
}

TEST(Adjoint, IsConjugation) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const Pose a = random.pose(2);
    Twist twist = any_twist(random);
    twist.tail<3>() *= 0.9;
    ASSERT_LT(distance(a * se3_exp(twist) * a.inverse(), se3_exp(adjoint(a) * twist)), 2e-13);
    ASSERT_LT((se3_log(a * se3_exp(twist) * a.inverse()) - adjoint(a, twist)).norm(), 2e-12);
    ASSERT_LT((adjoint(a) * twist - adjoint(a, twist)).norm(), 6e-14);
  }
}

TEST(Adjoint, IsAHomomorphism) {
  testing::Random random;
  EXPECT_EQ(adjoint(Pose::Identity()), Matrix6(Matrix6::Identity()));
  for (int i = 0; i < 3000; ++i) {
    const Pose a = random.pose(2), b = random.pose(2);
    ASSERT_LT((adjoint(a * b) - adjoint(a) * adjoint(b)).norm(), 6e-14);
    ASSERT_LT((adjoint(a.inverse()) * adjoint(a) - Matrix6::Identity()).norm(), 6e-14);
    ASSERT_NEAR(adjoint(a).determinant(), 1, 3e-13);
  }
}

TEST(Interpolate, BeginsAtFromAndEndsAtTo) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const Pose from = random.pose(3), to = random.pose(3);
    ASSERT_EQ(distance(interpolate(from, to, 0), from), 0);
    ASSERT_LT(distance(interpolate(from, to, 1), to), 3e-14);
    ASSERT_LT(distance(interpolate(from, from, random.uniform(0, 1)), from), 3e-15)
        << "no motion between equal poses";
  }
}

TEST(Interpolate, MovesStraightAtConstantSpeedByTheShortestRotation) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const Pose from = random.pose(3), to = random.pose(3);
    const double s = random.uniform(0, 1), h = random.uniform(0, 1 - s);
    const Pose a = interpolate(from, to, s), b = interpolate(from, to, s + h);
    const Vector3 way = to.translation() - from.translation();
    ASSERT_LT((b.translation() - a.translation() - h * way).norm(), 3e-14);
    const double whole = Eigen::AngleAxisd(from.linear().transpose() * to.linear()).angle();
    const double part = so3_log(a.linear().transpose() * b.linear()).norm();
    ASSERT_NEAR(part, h * whole, 3e-14);
    if (whole > pi - 1e-3) continue;  // at pi both rotations are equally short
    ASSERT_LT(distance(interpolate(to, from, 1 - s), a), 1e-11)
        << "the reversed line is the same line";
  }
}

TEST(PoseDifference, IsThePositionDifferenceAndTheRotationVectorInCommonAxes) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const Pose from = random.pose(3), to = random.pose(3);
    const Twist difference = pose_difference(to, from);
    ASSERT_EQ(difference.head<3>(), to.translation() - from.translation());
    ASSERT_LT((so3_exp(difference.tail<3>()) * from.linear() - to.linear()).norm(), 3e-14);
    const Rotation axes = random.rotation();
    const Twist turned = pose_difference(axes * to, axes * from);
    if (difference.tail<3>().norm() > pi - 1e-3) continue;
    ASSERT_LT((turned.head<3>() - axes * difference.head<3>()).norm(), 3e-13);
    ASSERT_LT((turned.tail<3>() - axes * difference.tail<3>()).norm(), 3e-13);
  }
}

}  // namespace
}  // namespace beeline
