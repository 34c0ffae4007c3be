#include <cmath>
#include <gtest/gtest.h>

#include <beeline/math/minimise.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

TEST(GoldenSection, FindsTheMinimumOfAParabolaAndOfAKink) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const double low = random.uniform(-2, 0), high = random.uniform(0.1, 2);
    const double at = random.uniform(low, high);
    const Minimum smooth =
        golden_section(low, high, 60, [&](double x) { return 3 + (x - at) * (x - at); });
    ASSERT_NEAR(smooth.x, at, 1e-7);
    ASSERT_NEAR(smooth.value, 3, 1e-14);
    const Minimum kink = golden_section(low, high, 60, [&](double x) { return std::abs(x - at); });
    ASSERT_NEAR(kink.x, at, 1e-11);
  }
}

TEST(ScanAndRefine, FindsTheLeastOfSeveralMinima) {
  testing::Random random;
  for (int i = 0; i < 100; ++i) {
    const double phase = random.uniform(0, 6);
    const auto f = [&](double x) { return std::cos(4 * x + phase) + 0.05 * x; };
    double least = HUGE_VAL;
    for (int k = 0; k <= 100'000; ++k) least = std::min(least, f(7e-5 * k));
    const Minimum found = scan_and_refine(0, 7, 128, 40, f);
    ASSERT_NEAR(found.value, least, 1e-7);
    ASSERT_EQ(found.value, f(found.x));
  }
}

TEST(ScanAndRefine, ReturnsAnEndWhereTheFunctionIsMonotone) {
  const Minimum low = scan_and_refine(1, 2, 8, 40, [](double x) { return x; });
  EXPECT_EQ(low.x, 1);
  const Minimum high = scan_and_refine(1, 2, 8, 40, [](double x) { return -x; });
  EXPECT_EQ(high.x, 2);
  EXPECT_EQ(high.value, -2);
}

}  // namespace
}  // namespace beeline::internal
