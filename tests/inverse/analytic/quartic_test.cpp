#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include <beeline/inverse/analytic/quartic.h>

#include <tests/random.h>

namespace beeline::internal {
namespace {

using testing::Random;
using Quartic = std::array<double, 5>;

/// lead (x - a) (x - b) (x^2 - 2 m x + n)
Quartic product(double lead, double a, double b, double m, double n) {
  const double sum = -(a + b), both = a * b, middle = -2 * m;
  return {lead * both * n, lead * (sum * n + both * middle), lead * (n + sum * middle + both),
          lead * (middle + sum), lead};
}

/// The absolute value at x, relative to the sum of the absolute values of its terms.
double relative_value(const Quartic& c, double x) {
  double value = 0, terms = 0;
  for (std::size_t i = 5; i-- > 0;) {
    value = value * x + c[i];
    terms = terms * std::abs(x) + std::abs(c[i]);
  }
  return terms == 0 ? 0 : std::abs(value) / terms;
}

/// The roots, sorted. Each has a relative value of at most `rounding`.
std::vector<double> roots_of(const Quartic& c, double rounding = 1e-6) {
  std::array<double, 4> roots{};
  const int count = quartic_roots(c, roots);
  EXPECT_TRUE(count == 0 || count == 2 || count == 4) << count;  // complex roots come in pairs
  std::vector<double> sorted(roots.begin(), roots.begin() + std::clamp(count, 0, 4));
  std::sort(sorted.begin(), sorted.end());
  for (const double x : sorted) EXPECT_LE(relative_value(c, x), rounding) << x;
  return sorted;
}

/// Checks that the roots are the expected ones, to `tolerance` times `size`.
void expect_roots(const Quartic& c, std::vector<double> expected, double tolerance, double size,
                  double rounding = 1e-14) {
  std::sort(expected.begin(), expected.end());
  const std::vector<double> found = roots_of(c);
  ASSERT_EQ(found.size(), expected.size()) << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3];
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], tolerance * size);
    EXPECT_LE(relative_value(c, found[i]), rounding);
  }
}

/// Random numbers in [-size, size], at least `apart` times size from each other.
std::vector<double> distinct(int count, double size, double apart, Random& random) {
  std::vector<double> numbers;
  while (static_cast<int>(numbers.size()) < count) {
    const double x = random.uniform(-size, size);
    const bool near = std::any_of(numbers.begin(), numbers.end(),
                                  [&](double other) { return std::abs(x - other) < apart * size; });
    if (!near) numbers.push_back(x);
  }
  return numbers;
}

double lead(Random& random) {
  return std::pow(10, random.uniform(-3, 3)) * (random.integer(0, 1) == 0 ? 1 : -1);
}

TEST(Quartic, FindsFourRoots) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const auto x = distinct(4, 3, 0.02, random);
    const double m = (x[2] + x[3]) / 2;
    expect_roots(product(lead(random), x[0], x[1], m, x[2] * x[3]), x, 1e-10, 3);
  }
}

TEST(Quartic, FindsTwoRootsBesideAComplexPair) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const auto x = distinct(2, 3, 0.02, random);
    const double real = random.uniform(-3, 3), imaginary = random.uniform(0.1, 3);
    const double n = real * real + imaginary * imaginary;
    expect_roots(product(lead(random), x[0], x[1], real, n), x, 1e-10, 3);
  }
}

TEST(Quartic, FindsNoneOfTwoComplexPairs) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const double m1 = random.uniform(-3, 3), m2 = random.uniform(-3, 3);
    const double n1 = m1 * m1 + random.uniform(0.01, 9), n2 = m2 * m2 + random.uniform(0.01, 9);
    const double by = lead(random);
    EXPECT_TRUE(roots_of({by * n1 * n2, -2 * by * (m1 * n2 + m2 * n1), by * (n1 + n2 + 4 * m1 * m2),
                          -2 * by * (m1 + m2), by})
                    .empty());
  }
}

TEST(Quartic, FindsDoubleRootsWithTheirMultiplicity) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const auto x = distinct(3, 3, 0.1, random);
    const double by = lead(random);
    const double n = x[1] * x[1] + random.uniform(0.1, 3);
    expect_roots(product(by, x[0], x[1], x[2], x[2] * x[2]), {x[0], x[1], x[2], x[2]}, 1e-4, 3,
                 1e-7);
    expect_roots(product(by, x[0], x[0], x[2], x[2] * x[2]), {x[0], x[0], x[2], x[2]}, 1e-4, 3,
                 1e-7);
    expect_roots(product(by, x[0], x[0], x[1], n), {x[0], x[0]}, 1e-4, 3, 1e-7);
  }
}

/// A triple root is known to a third of the digits; the simple root beside it is exact.
TEST(Quartic, FindsTripleRoots) {
  Random random;
  for (int i = 0; i < 20000; ++i) {
    const auto x = distinct(2, 3, 0.1, random);
    // Near zero, the relative value of a triple root is arbitrary.
    const auto found = roots_of(product(lead(random), x[0], x[1], x[0], x[0] * x[0]), 1);
    const auto holds = [&found](double root, double tolerance) {
      return std::any_of(found.begin(), found.end(),
                         [&](double each) { return std::abs(each - root) < tolerance; });
    };
    EXPECT_TRUE(holds(x[0], 1e-2)) << x[0] << ' ' << x[1];
    EXPECT_TRUE(holds(x[1], 1e-9)) << x[0] << ' ' << x[1];
  }
}

TEST(Quartic, FindsRootsOfEvenPolynomialsAndOfPowers) {
  expect_roots({0, 0, 0, 0, 2}, {0, 0, 0, 0}, 1e-6, 2);
  expect_roots({-1, 0, 0, 0, 1}, {-1, 1}, 1e-15, 2);
  expect_roots({4, 0, -5, 0, 1}, {-2, -1, 1, 2}, 1e-15, 2);
  expect_roots({0, 0, -1, 0, 1}, {-1, 0, 0, 1}, 1e-8, 2);
  expect_roots({0, -1, 0, 0, 1}, {0, 1}, 1e-15, 2);
  EXPECT_TRUE(roots_of({1, 0, 0, 0, 1}).empty());
  EXPECT_TRUE(roots_of({4, 0, 5, 0, 1}).empty());
}

/// The roots do not depend on the units of the unknown and of the polynomial.
TEST(Quartic, IsIndependentOfScale) {
  Random random;
  for (const double size : {1e-9, 1e-6, 1e-3, 1e3, 1e6, 1e9}) {
    for (const double by : {1e-30, 1e-9, 1e9, 1e30}) {
      for (int i = 0; i < 500; ++i) {
        const auto x = distinct(4, size, 0.02, random);
        SCOPED_TRACE(size);
        expect_roots(product(by, x[0], x[1], (x[2] + x[3]) / 2, x[2] * x[3]), x, 1e-9, size);
        const double imaginary = random.uniform(0.1, 1) * size;
        expect_roots(product(by, x[0], x[1], x[2], x[2] * x[2] + imaginary * imaginary),
                     {x[0], x[1]}, 1e-9, size);
        expect_roots(product(by, x[0], x[0], x[2], x[2] * x[2] + imaginary * imaginary),
                     {x[0], x[0]}, 1e-4, size, 1e-7);
      }
    }
  }
}

/// With a small leading coefficient one root is large; the others keep their precision.
TEST(Quartic, FindsRootsWithASmallLeadingCoefficient) {
  Random random;
  for (const double far : {1e2, 1e3, 1e4}) {
    for (int i = 0; i < 2000; ++i) {
      const auto x = distinct(3, 3, 0.05, random);
      const Quartic c = product(1 / far, x[0], far, (x[1] + x[2]) / 2, x[1] * x[2]);
      const auto found = roots_of(c);
      ASSERT_EQ(found.size(), 4U) << far;
      EXPECT_NEAR(found[3], far, 1e-6 * far);
      for (const double root : x) {
        EXPECT_TRUE(std::any_of(found.begin(), found.end(), [root](double each) {
          return std::abs(each - root) < 1e-9;
        })) << far;
      }
    }
  }
}

}  // namespace
}  // namespace beeline::internal
