#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

#include <beeline/formula/expression.h>

#include <tests/formula/random_expression.h>

namespace beeline {
namespace {

using testing::cases;
using testing::Random;
using testing::random_angle;
using testing::random_coefficient;
using testing::random_expression;
using testing::random_values;

TEST(Coefficient, HasTheCosinesAndSinesOfMultiplesOf15Degrees) {
  for (int m = -50; m <= 50; ++m) {
    const double angle = m * std::numbers::pi / 12;
    EXPECT_NEAR(Coefficient::cosine_of_multiple_of_15_degrees(m).value(), std::cos(angle), 1e-14)
        << m;
    EXPECT_NEAR(Coefficient::sine_of_multiple_of_15_degrees(m).value(), std::sin(angle), 1e-14)
        << m;
    const Coefficient c = Coefficient::cosine_of_multiple_of_15_degrees(m),
                      s = Coefficient::sine_of_multiple_of_15_degrees(m);
    EXPECT_EQ(c * c + s * s, Coefficient(1)) << m;
    EXPECT_TRUE(c.exact() && s.exact());
  }
}

TEST(Coefficient, IsAFieldsElement) {
  Random random;
  for (int k = 0; k < cases(10000); ++k) {
    const Coefficient a = random_coefficient(random), b = random_coefficient(random),
                      c = random_coefficient(random);
    EXPECT_EQ(a + b, b + a);
    EXPECT_EQ(a * b, b * a);
    EXPECT_EQ((a + b) + c, a + (b + c));
    EXPECT_EQ((a * b) * c, a * (b * c));
    EXPECT_EQ(a * (b + c), a * b + a * c);
    EXPECT_TRUE((a - a).is_zero());
    EXPECT_NEAR((a * b).value(), a.value() * b.value(), 1e-12);
    EXPECT_NEAR((a + b).value(), a.value() + b.value(), 1e-12);
  }
}

TEST(Coefficient, IsPlainWhereIntegersOverflow) {
  constexpr std::int64_t large = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  for (const std::int64_t n : {large, lowest, large / 2 + 1}) {
    const Coefficient a = Coefficient::exactly({n, 0, 0, 0}, 3);
    const double value = static_cast<double>(n) / 3;
    EXPECT_FALSE((a * a).exact());
    EXPECT_NEAR((a * a).value(), value * value, 1e-12 * value * value);
    EXPECT_NEAR((a + a + a + a).value(), 4 * value, std::abs(1e-12 * value));
    EXPECT_NEAR((-a).value(), -value, std::abs(1e-12 * value));
  }
  EXPECT_THROW(Coefficient::exactly({1, 0, 0, 0}, 0), Error);
}

TEST(Expression, IsARing) {
  Random random;
  for (int k = 0; k < cases(300); ++k) {
    const Expression a = random_expression(random), b = random_expression(random),
                     c = random_expression(random, 2);
    EXPECT_EQ(a + b, b + a);
    EXPECT_EQ(a * b, b * a);
    EXPECT_EQ((a * b) * c, a * (b * c));
    EXPECT_EQ(a * (b + c), a * b + a * c);
    EXPECT_TRUE((a - a).is_zero());
    EXPECT_EQ(Expression(1) * a, a);
  }
}

TEST(Expression, HasTheValuesOfItsParts) {
  Random random;
  for (int k = 0; k < cases(300); ++k) {
    const Expression a = random_expression(random), b = random_expression(random);
    const std::vector<double> values = random_values(random);
    EXPECT_NEAR((a * b).value(values), a.value(values) * b.value(values), 1e-9);
    EXPECT_NEAR((a + b).value(values), a.value(values) + b.value(values), 1e-9);
  }
}

TEST(Expression, EqualsExactlyTheSameFunctions) {
  const Angle one{3, {{3, 1}}}, two{3, {{4, 1}}};
  const Expression c1 = Expression::cosine(one), s1 = Expression::sine(one);
  const Expression c12 = Expression::cosine(one + two), s12 = Expression::sine(one + two);
  EXPECT_EQ(c1 * c1 + s1 * s1, Expression(1));
  EXPECT_EQ(s12 * c1 - c12 * s1, Expression::sine(two));
  EXPECT_EQ(c12 * c1 + s12 * s1, Expression::cosine(two));
  EXPECT_EQ(Expression::sine(-1 * one), -s1);
  EXPECT_EQ(Expression::cosine(-1 * one), c1);
  EXPECT_FALSE(c12 == c1);
  EXPECT_FALSE(c1 * c1 == s1 * s1);
}

TEST(Expression, HasTheDerivativeOfItsFunction) {
  Random random;
  constexpr double h = 1e-6;
  for (int k = 0; k < cases(300); ++k) {
    const Expression a = random_expression(random), b = random_expression(random);
    for (int symbol = 0; symbol < testing::symbol_count; ++symbol) {
      EXPECT_EQ((a * b).derivative(symbol), a.derivative(symbol) * b + a * b.derivative(symbol));
      std::vector<double> before = random_values(random), after = before;
      const double exact = a.derivative(symbol).value(before);
      before[static_cast<std::size_t>(symbol)] -= h;
      after[static_cast<std::size_t>(symbol)] += h;
      EXPECT_NEAR(exact, (a.value(after) - a.value(before)) / (2 * h), 1e-6);
    }
  }
}

}  // namespace
}  // namespace beeline
