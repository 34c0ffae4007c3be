#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/math/hermite.h>

#include <tests/random.h>

namespace beeline {
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

TEST(Cubic, TellsHowFarItGoesWithinItsStep) {
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
    EXPECT_LE(extremes(cubic).least, least);
    EXPECT_GE(extremes(cubic).largest, largest);
    EXPECT_NEAR(extremes(cubic).least, least, 1e-5);
    EXPECT_NEAR(extremes(cubic).largest, largest, 1e-5);
  }
}

}  // namespace
}  // namespace beeline
