#include <beeline/trajectory/internal/mean_derivative.h>

#include <tests/certificate/two_joints.h>

namespace beeline::internal {
namespace {

using namespace testing;

TEST(MeanDerivative, IsExactForPolynomials) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    const double a = random.uniform(-3, 3), b = random.uniform(-3, 3), c = random.uniform(-3, 3);
    const auto cubic = [&](double t) { return a + b * t + c * t * t * t; };
    const Trajectory motion = along(
        cubic, [&](double t) { return b + c * t * t; }, 2);
    for (std::size_t k = 0; k + 4 < motion.size(); ++k) {
      EXPECT_NEAR(mean_derivative(motion, k, 0, 3), std::abs(6 * c), 1e-7);
      EXPECT_NEAR(mean_derivative(motion, k, 1, 2), std::abs(2 * c), 1e-8);
      EXPECT_NEAR(mean_derivative(motion, k, 1, 3), 0, 1e-7);
    }
  }
}

// By the mean value theorem a divided difference does not exceed the derivative at any sampling
// rate.
TEST(MeanDerivative, IsNeverMoreThanASmoothMotionNeeds) {
  for (const int count : {4, 10, 100, 1000, 30'000}) {
    const Trajectory motion = along([](double t) { return std::sin(t); },
                                    [](double t) { return std::sin(2 * t); }, 6, count);
    for (std::size_t k = 0; k < motion.size(); ++k) {
      for (int order = 1; order <= 3; ++order) {
        ASSERT_LE(mean_derivative(motion, k, 0, order), 1 + 1e-9) << count;
        ASSERT_LE(mean_derivative(motion, k, 1, order), std::pow(2, order) * (1 + 1e-9));
      }
    }
  }
}

// A standstill of two samples in a constant velocity: the long interval hides it from a divided
// difference.
TEST(NeededDerivative, CountsAChangeOfVelocityWithinTheShorterInterval) {
  Trajectory motion = along([](double t) { return t; }, [](double t) { return t * t; }, 1);
  motion.times = {0, 0.01, 1.01, 1.02};
  motion.positions = {Configuration{{0, 0}}, Configuration{{0.01, 0}}, Configuration{{0.01, 0}},
                      Configuration{{0.02, 0}}};
  EXPECT_NEAR(mean_derivative(motion, 0, 0, 2), 2 / 1.01, 1e-9);
  EXPECT_NEAR(needed_derivative(motion, 0, 0, 2), 50, 1e-9);
  EXPECT_EQ(needed_derivative(motion, 0, 0, 3), mean_derivative(motion, 0, 0, 3));
  motion.velocities = motion.positions;  // cubics have an acceleration
  EXPECT_EQ(needed_derivative(motion, 0, 0, 2), mean_derivative(motion, 0, 0, 2));
  const Trajectory even = along([](double t) { return t; }, [](double t) { return t * t; }, 1);
  for (std::size_t k = 0; k + 2 < even.size(); ++k) {
    EXPECT_NEAR(needed_derivative(even, k, 1, 2), 2, 1e-8);
  }
}

TEST(MeanDerivative, IsZeroForTooFewSamples) {
  const Trajectory motion = along([](double t) { return t * t * t; }, nothing, 1, 3);
  EXPECT_GT(mean_derivative(motion, 0, 0, 3), 5);
  EXPECT_EQ(mean_derivative(motion, 1, 0, 3), 0);
  EXPECT_EQ(mean_derivative(motion, 3, 0, 1), 0);
}

}  // namespace
}  // namespace beeline::internal
