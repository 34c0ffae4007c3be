#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/math/hermite.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

TEST(Cubic, HasTheValuesAndSlopesOfItsEnds) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const double from = random.uniform(-3, 3), to = random.uniform(-3, 3), h = random.uniform(0, 2);
    const double v = random.uniform(-9, 9), w = random.uniform(-9, 9);
    const Cubic cubic = cubic_between(from, to, v, w, h);
    EXPECT_EQ(cubic.value(0), from);
    EXPECT_NEAR(cubic.value(1), to, 1e-13 * (10 + 9 * h));
    EXPECT_NEAR(cubic.velocity(0), v, 1e-12);
    EXPECT_NEAR(cubic.velocity(1), w, 1e-12 * (10 + 10 / h));
    const double u = random.uniform(0.01, 0.99), d = 1e-5;
    const double mean = (cubic.velocity(u + d) - cubic.velocity(u - d)) / (2 * d * h);
    EXPECT_NEAR(cubic.acceleration(u), mean, 1e-7 * (10 + 10 / h) / h);
  }
}

TEST(Cubic, ReportsItsExtremesOverTheStep) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const auto slope = [&] { return i % 5 == 0 ? 0 : random.uniform(-9, 9); };
    const double from = random.uniform(-1, 1), to = i % 7 == 0 ? from : random.uniform(-1, 1);
    const Cubic cubic = cubic_between(from, to, slope(), slope(), random.uniform(0.1, 1));
    double least = from, largest = from;
    for (int k = 1; k <= 2000; ++k) {
      least = std::min(least, cubic.value(k / 2000.0));
      largest = std::max(largest, cubic.value(k / 2000.0));
    }
    EXPECT_LE(extremes(cubic).smallest, least);
    EXPECT_GE(extremes(cubic).largest, largest);
    EXPECT_NEAR(extremes(cubic).smallest, least, 1e-5);
    EXPECT_NEAR(extremes(cubic).largest, largest, 1e-5);
  }
}

TEST(Quintic, HasTheDerivativesOfItsEndsAndThoseOfItsValues) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const auto any = [&] { return random.uniform(-2, 2); };
    const double change = any(), d0 = any(), dd0 = any(), d1 = any(), dd1 = any();
    const Quintic<double> quintic = quintic_between(change, d0, dd0, d1, dd1);
    ASSERT_EQ(quintic.change(0), 0);
    ASSERT_NEAR(quintic.change(1), change, 1e-12);
    ASSERT_EQ(quintic.first(0), d0);
    ASSERT_NEAR(quintic.first(1), d1, 1e-12);
    ASSERT_EQ(quintic.second(0), dd0);
    ASSERT_NEAR(quintic.second(1), dd1, 1e-11);
    const double u = random.uniform(0.1, 0.9), h = 1e-5;
    ASSERT_NEAR((quintic.change(u + h) - quintic.change(u - h)) / (2 * h), quintic.first(u), 1e-6);
    ASSERT_NEAR((quintic.first(u + h) - quintic.first(u - h)) / (2 * h), quintic.second(u), 1e-6);
    ASSERT_NEAR((quintic.second(u + h) - quintic.second(u - h)) / (2 * h), quintic.third(u), 1e-5);
  }
}

TEST(RestToRest, IsTheQuinticBetweenTwoStops) {
  const Quintic<double> quintic = quintic_between(1.0, 0.0, 0.0, 0.0, 0.0);
  for (const double u : {0.0, 0.1, 0.25, 0.5, 0.8, 1.0}) {
    const RestToRest motion = rest_to_rest(u);
    EXPECT_NEAR(motion.value, quintic.change(u), 1e-14);
    EXPECT_NEAR(motion.first, quintic.first(u), 1e-13);
    EXPECT_NEAR(motion.second, quintic.second(u), 1e-12);
    EXPECT_NEAR(motion.third, quintic.third(u), 1e-11);
  }
  EXPECT_EQ(rest_to_rest(1).first, 0);
  EXPECT_EQ(rest_to_rest(1).second, 0);
}

}  // namespace
}  // namespace beeline::internal
