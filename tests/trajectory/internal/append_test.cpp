#include <gtest/gtest.h>

#include <beeline/trajectory/internal/append.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

Trajectory section(double duration, double from) {
  return {{"a"},
          {0, duration},
          {Configuration::Constant(1, from), Configuration::Constant(1, from + 1)},
          {},
          {}};
}

TEST(Append, LeavesOutTheFirstSampleAndShiftsTheTimes) {
  Trajectory all;
  append(all, section(0.5, 0));
  append(all, section(0.25, 1));
  EXPECT_EQ(all.times, (std::vector<double>{0, 0.5, 0.75}));
  EXPECT_EQ(all.positions.back()[0], 2);
}

TEST(RoundTimes, MakesThemWholeNanoseconds) {
  testing::Random random;
  Trajectory all;
  for (int i = 0; i < 1000; ++i) {
    append(all, section(round_to_nanoseconds(random.uniform(0.001, 3)), i));
  }
  const std::vector<double> sums = all.times;
  round_times(all);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    ASSERT_NEAR(all.times[k], sums[k], 1e-9);
    ASSERT_EQ(all.times[k], round_to_nanoseconds(all.times[k]));
  }
}

}  // namespace
}  // namespace beeline::internal
