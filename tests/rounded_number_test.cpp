#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include <beeline/error.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

double value_of(const std::string& percentage) {
  EXPECT_TRUE(percentage.ends_with(" %")) << percentage;
  return std::stod(percentage) / 100;
}

TEST(Percent, HasTheDigitsThatMeanSomething) {
  EXPECT_EQ(percent(0.636849), "63.7 %");
  EXPECT_EQ(percent(1), "100 %");
  EXPECT_EQ(percent(0), "0 %");
  EXPECT_EQ(percent(-1e-17), "0 %");
  EXPECT_EQ(percent(0.000199075), "0.02 %");
  EXPECT_EQ(percent(43.83471), "4383 %");
  EXPECT_EQ(percent(std::numeric_limits<double>::infinity()), "inf %");
}

TEST(Percent, IsWithinHalfAUnitOfItsLastDigit) {
  testing::Random random;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const double fraction = std::pow(10, random.uniform(-6, 3));
    const std::string text = percent(fraction);
    const double relative = fraction < 0.01 ? 0.05
                            : fraction < 10 ? 5e-4 / fraction
                                            : 5e-3 / fraction;
    EXPECT_NEAR(value_of(text), fraction, 1.0001 * relative * fraction) << text;
    EXPECT_LE(text.size(), std::string("0.00012 %").size()) << text;
  }
}

TEST(PercentAtMost, IsABoundAndShowsEveryExcess) {
  EXPECT_EQ(percent_at_most(0.998889), "99.9 %");
  EXPECT_EQ(percent_at_most(0.999332), "100 %");
  EXPECT_EQ(percent_at_most(1 + 5e-7), "100 %");
  EXPECT_EQ(percent_at_most(1 + 2e-6), "100.1 %");
  EXPECT_EQ(percent_at_most(0.464), "46.4 %");
  testing::Random random;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const double fraction = std::pow(10, random.uniform(-6, 3));
    EXPECT_GE(value_of(percent_at_most(fraction)), fraction * (1 - 1e-14));
    EXPECT_LE(value_of(percent_at_most(fraction)), 1.1 * fraction + 1e-9);
    const double excess = 1 + std::pow(10, random.uniform(-5.9, 0));
    EXPECT_GT(value_of(percent_at_most(excess)), 1) << excess;
  }
}

TEST(NumberAtLeast, IsASixDigitNumberNotBelow) {
  EXPECT_EQ(number_at_least(1.38), "1.38");
  EXPECT_EQ(number_at_least(4.7412341), "4.74124");
  EXPECT_EQ(number_at_least(9.9999991), "10");
  testing::Random random;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const double value = random.uniform(-1, 1) * std::pow(10, random.uniform(-9, 9));
    const double rounded = std::stod(number_at_least(value));
    EXPECT_GE(rounded, value);
    EXPECT_LE(rounded, value + 1.01e-5 * std::abs(value));
  }
}

TEST(RoundedUp, KeepsSoManyDigitsAndIsNotBelow) {
  EXPECT_DOUBLE_EQ(rounded_up(5.6021e-5, 3), 5.61e-5);
  EXPECT_DOUBLE_EQ(rounded_up(0.25, 3), 0.25);
  EXPECT_EQ(rounded_up(0, 3), 0);
  testing::Random random;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const double value = std::pow(10, random.uniform(-12, 9));
    EXPECT_GE(rounded_up(value, 3) * (1 + 1e-15), value);
    EXPECT_LE(rounded_up(value, 3), value * 1.0101);
  }
}

TEST(RoundedDown, KeepsSoManyDigitsAndIsNotAbove) {
  EXPECT_DOUBLE_EQ(rounded_down(5.6099e-5, 3), 5.60e-5);
  EXPECT_DOUBLE_EQ(rounded_down(-5.6021e-5, 3), -5.61e-5);
  EXPECT_DOUBLE_EQ(rounded_down(0.25, 3), 0.25);
  EXPECT_EQ(rounded_down(0, 3), 0);
  testing::Random random;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const double value = std::pow(10, random.uniform(-12, 9));
    EXPECT_LE(rounded_down(value, 3) * (1 - 1e-15), value);
    EXPECT_GE(rounded_down(value, 3), value * 0.9899);
    EXPECT_EQ(rounded_down(-value, 3), -rounded_up(value, 3));
  }
}

TEST(NumberApart, DiffersFromTheReferenceWhereTheNumbersDo) {
  EXPECT_EQ(number_apart(2.61, 1), "2.61");
  EXPECT_EQ(number_apart(1, 1), "1");
  EXPECT_EQ(number_apart(1.000002, 1), "1.000002");
  testing::Random random;
  for (int i = 0; i < testing::cases(2000); ++i) {
    const double reference = random.uniform(-10, 10);
    const double value = reference * (1 + std::pow(10, random.uniform(-15, 0)));
    EXPECT_NE(number_apart(value, reference), number(reference));
    EXPECT_NEAR(std::stod(number_apart(value, reference)), value, 6e-6 * std::abs(value));
  }
}

}  // namespace
}  // namespace beeline::internal
