#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/pose/internal/rotation_rates.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

using std::numbers::pi;

TEST(RotationRates, AreThoseOfTheExponentialByDifferences) {
  testing::Random random;
  constexpr double h = 1e-4;
  for (int i = 0; i < 3000; ++i) {
    const double size = std::pow(10, random.uniform(-6, 0.5));
    const Vector3 r = random.direction() * size, rate = random.vector(), second = random.vector();
    const auto at = [&](double t) { return so3_exp(r + t * rate + t * t / 2 * second); };
    const Vector3 ahead = so3_log(at(h) * at(0).transpose());
    const Vector3 back = so3_log(at(-h) * at(0).transpose());
    const RotationRates motion = angular_motion(r, {rate, second});
    ASSERT_LT((motion.velocity - (ahead - back) / (2 * h)).norm(), 1e-7) << size;
    ASSERT_LT((motion.acceleration - (ahead + back) / (h * h)).norm(), 1e-6) << size;
    const RotationRates again = rotation_vector_rates(r, motion);
    ASSERT_LT((again.velocity - rate).norm(), 1e-11) << size;
    ASSERT_LT((again.acceleration - second).norm(), 1e-10) << size;
  }
}

TEST(RotationRates, HaveTheAccelerationBoundThatTheCertificateUses) {
  testing::Random random;
  double most = 0;
  for (int i = 0; i < 50000; ++i) {
    const Vector3 r = random.direction() * random.uniform(0, pi), rate = random.vector();
    const double change = angular_motion(r, {rate, Vector3::Zero()}).acceleration.norm();
    const double bound = r.cross(rate).norm() * rate.norm() / 6;
    ASSERT_LE(change, bound * (1 + 1e-9));
    ASSERT_LE(angular_motion(r, {rate, rate}).velocity.norm(), rate.norm() * (1 + 1e-12));
    most = std::max(most, change / bound);
  }
  EXPECT_GT(most, 0.99);
}

}  // namespace
}  // namespace beeline::internal
