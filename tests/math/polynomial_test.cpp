#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/math/polynomial.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

Polynomial random_polynomial(testing::Random& random) {
  Polynomial p;
  for (double& c : p.c) c = random.uniform(-1, 1);
  return p;
}

TEST(Polynomial, EnclosureContainsTheExtremesAndTheseAllValues) {
  testing::Random random;
  constexpr int looks = 500;
  for (int i = 0; i < 5000; ++i) {
    const Polynomial p = random_polynomial(random);
    const Extremes exact = extremes(p), wide = enclosure(p);
    double smallest = p(0), largest = p(0);
    for (int k = 0; k <= looks; ++k) {
      smallest = std::min(smallest, p(double(k) / looks));
      largest = std::max(largest, p(double(k) / looks));
    }
    ASSERT_LE(exact.smallest, smallest);
    ASSERT_GE(exact.largest, largest);
    ASSERT_NEAR(exact.smallest, smallest, 2e-4);
    ASSERT_NEAR(exact.largest, largest, 2e-4);
    ASSERT_LE(wide.smallest, exact.smallest + 1e-14);
    ASSERT_GE(wide.largest, exact.largest - 1e-14);
  }
}

TEST(Polynomial, PartIsTheSamePolynomialOfAnotherVariable) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Polynomial p = random_polynomial(random);
    const double from = random.uniform(0, 1), to = random.uniform(0, 1), v = random.uniform(0, 1);
    ASSERT_NEAR(p.part(from, to)(v), p(from + v * (to - from)), 1e-13);
    ASSERT_NEAR(p.part(from, to).derivative()(v),
                (to - from) * p.derivative()(from + v * (to - from)), 1e-12);
  }
}

TEST(Polynomial, HermitePolynomialsMeetTheirEnds) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    double x[6];
    for (double& value : x) value = random.uniform(-1, 1);
    const Polynomial line = line_between(x[0], x[1]);
    const Polynomial cubic = cubic_between(x[0], x[1], x[2], x[3]);
    const Polynomial quintic = quintic_between(x[0], x[1], x[2], x[3], x[4], x[5]);
    for (const Polynomial& p : {line, cubic, quintic}) {
      ASSERT_NEAR(p(0), x[0], 1e-13);
      ASSERT_NEAR(p(1), x[1], 1e-13);
    }
    for (const Polynomial& p : {cubic, quintic}) {
      ASSERT_NEAR(p.derivative()(0), x[2], 1e-12);
      ASSERT_NEAR(p.derivative()(1), x[3], 1e-12);
    }
    ASSERT_NEAR(quintic.derivative().derivative()(0), x[4], 1e-12);
    ASSERT_NEAR(quintic.derivative().derivative()(1), x[5], 1e-12);
  }
}

TEST(Polynomial, LargestDecreaseIsThatOfItsValues) {
  testing::Random random;
  for (int i = 0; i < 1000; ++i) {
    Polynomial p;
    for (double& c : p.c) c = random.uniform(-1, 1);
    double largest = p(0), decrease = 0;
    for (int k = 0; k <= 2000; ++k) {
      const double value = p(k / 2000.0);
      largest = std::max(largest, value);
      decrease = std::max(decrease, largest - value);
    }
    ASSERT_NEAR(largest_decrease(p), decrease, 1e-5);
    ASSERT_GE(largest_decrease(p), decrease - 1e-14);
    const double before = random.uniform(-1, 1);
    ASSERT_NEAR(largest_decrease(p, before), std::max(decrease, before - extremes(p).smallest),
                1e-5);
  }
  EXPECT_EQ(largest_decrease({{1, 2, 0, 3}}), 0);
}

}  // namespace
}  // namespace beeline::internal
