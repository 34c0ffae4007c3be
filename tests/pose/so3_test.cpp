#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/pose/so3.h>

#include <tests/random.h>

namespace beeline {
namespace {

using std::numbers::pi;
using LongMatrix3 = Eigen::Matrix<long double, 3, 3>;

/// exp as its power series, in extended precision.
Rotation exp_series(const Vector3& w) {
  const LongMatrix3 w_hat = hat(w).cast<long double>();
  LongMatrix3 term = LongMatrix3::Identity(), sum = term;
  for (int k = 1; k < 60; ++k) {
    term = term * w_hat / k;
    sum += term;
  }
  return sum.cast<double>();
}

/// Angles of every magnitude up to pi - 1e-9: tiny ones, ordinary ones and ones close to pi.
double any_angle(testing::Random& random) {
  const double size = std::pow(10, random.uniform(-12, 0.5));
  const double far = pi - std::pow(10, random.uniform(-9, 0));
  return random.integer(0, 1) == 0 ? std::min(size, pi - 1e-9) : far;
}

TEST(Hat, IsTheCrossProductsMatrix) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Vector3 a = random.vector(), b = random.vector();
    ASSERT_EQ(hat(a).transpose(), -hat(a));
    ASSERT_LT((hat(a) * b - a.cross(b)).norm(), 3e-15);
  }
}

TEST(So3Exp, IsARotationForEveryLength) {
  testing::Random random;
  EXPECT_EQ(so3_exp(Vector3::Zero()), Rotation::Identity());
  for (int i = 0; i < 10000; ++i) {
    const Vector3 axis = random.direction();
    const Vector3 w = axis * std::pow(10, random.uniform(-200, 6));
    const Rotation r = so3_exp(w);
    ASSERT_LT((r * r.transpose() - Rotation::Identity()).norm(), 2e-14) << w.norm();
    ASSERT_NEAR(r.determinant(), 1, 2e-14);
    ASSERT_LT((so3_exp(-w) - r.transpose()).norm(), 3e-15) << "exp(-w) is the inverse";
    ASSERT_LT((r * axis - axis).norm(), 2e-14) << "the axis is invariant";
  }
}

TEST(So3Exp, EqualsItsPowerSeriesInExtendedPrecision) {
  testing::Random random;
  for (int i = 0; i < 3000; ++i) {
    const Vector3 w = random.direction() * any_angle(random);
    const Rotation exact = exp_series(w);
    const Rotation r = so3_exp(w);
    ASSERT_LT((r - exact).norm(), 6e-15) << w.norm();
    const Vector3 part{r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
    const Vector3 exact_part{exact(2, 1) - exact(1, 2), exact(0, 2) - exact(2, 0),
                             exact(1, 0) - exact(0, 1)};
    ASSERT_LT((part - exact_part).norm(), 3e-15 * w.norm()) << w.norm();
  }
}

TEST(So3Exp, AddsAnglesAboutOneAxisAndRotatesTheAxisWhenConjugated) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const Vector3 axis = random.direction();
    const double s = random.uniform(-7, 7), t = random.uniform(-7, 7);
    ASSERT_LT((so3_exp(s * axis) * so3_exp(t * axis) - so3_exp((s + t) * axis)).norm(), 3e-14);
    const Rotation r = random.rotation();
    ASSERT_LT((r * so3_exp(t * axis) * r.transpose() - so3_exp(t * (r * axis))).norm(), 3e-14);
  }
}

TEST(So3Log, IsTheInverseOfExpUpToAlmostPi) {
  testing::Random random;
  for (int i = 0; i < 20000; ++i) {
    const Vector3 w = random.direction() * any_angle(random);
    ASSERT_LT((so3_log(so3_exp(w)) - w).norm(), 1e-14 * w.norm()) << w.norm();
  }
  EXPECT_EQ(so3_log(Rotation::Identity()), Vector3::Zero());
  for (const double tiny : {1e-12, 1e-15, 1e-30, 1e-200}) {
    const Vector3 w = tiny * Vector3(0.6, 0, -0.8);
    EXPECT_LT((so3_log(so3_exp(w)) / tiny - w / tiny).norm(), 1e-15) << tiny;
  }
}

TEST(So3Log, IsInvertedByExpAndNeverLongerThanPi) {
  testing::Random random;
  for (int i = 0; i < 10000; ++i) {
    const Rotation r = so3_exp(random.vector(10)) * random.rotation();
    const Vector3 w = so3_log(r);
    ASSERT_LE(w.norm(), pi + 4e-15);
    ASSERT_LT((so3_exp(w) - r).norm(), 3e-14);
  }
}

TEST(So3Log, AtPiIsOneOfTheTwoOppositeVectors) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    Vector3 a = random.direction();
    if (i < 3) a = Vector3::Unit(i);
    if (i >= 3 && i < 6) a = (Vector3::Ones() - Vector3::Unit(i - 3)).normalized();
    const Rotation half_turn = 2 * a * a.transpose() - Rotation::Identity();
    const Vector3 w = so3_log(half_turn);
    ASSERT_NEAR(w.norm(), pi, 6e-15);
    ASSERT_LT((w / pi).cross(a).norm(), 3e-15);
    ASSERT_LT((so3_exp(w) - half_turn).norm(), 6e-15);
  }
}

TEST(So3Log, OfTheInverseIsTheOppositeVector) {
  testing::Random random;
  for (int i = 0; i < 5000; ++i) {
    const Rotation r = so3_exp(random.direction() * any_angle(random));
    ASSERT_LT((so3_log(r.transpose()) + so3_log(r)).norm(), 3e-14);
  }
}

TEST(So3LeftJacobian, IsTheDerivativeOfTheExponentialAndOfTheLogarithm) {
  testing::Random random;
  constexpr double h = 1e-5;
  for (int i = 0; i < 5000; ++i) {
    const Vector3 r = random.direction() * any_angle(random), rate = random.vector();
    const Rotation back = so3_exp(r).transpose();
    const Vector3 w =
        (so3_log(so3_exp(r + h * rate) * back) - so3_log(so3_exp(r - h * rate) * back)) / (2 * h);
    ASSERT_LT((so3_left_jacobian(r) * rate - w).norm(), 1e-8) << r.norm();
    const Eigen::Matrix3d product = so3_left_jacobian_inverse(r) * so3_left_jacobian(r);
    ASSERT_LT((product - Eigen::Matrix3d::Identity()).norm(), 1e-14) << r.norm();
    ASSERT_LT((so3_left_jacobian(-r) - so3_left_jacobian(r).transpose()).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace beeline
