#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace beeline::internal {

/// A polynomial c[0] + c[1] u + ... + c[5] u^5 for u from 0 to 1.
struct Polynomial {
  static constexpr std::size_t terms = 6;
  std::array<double, terms> c{};

  /// The value at u.
  double operator()(double u) const {
    double value = 0;
    for (std::size_t k = terms; k-- > 0;) value = value * u + c[k];
    return value;
  }

  /// The derivative with respect to u.
  Polynomial derivative() const {
    Polynomial d;
    for (std::size_t k = 1; k < terms; ++k) d.c[k - 1] = static_cast<double>(k) * c[k];
    return d;
  }

  /// The polynomial in v, from 0 to 1, with u = from + v (to - from).
  Polynomial part(double from, double to) const;
};

/// The line, and the cubic and the quintic Hermite polynomial, from p0 to p1 with the first and
/// second derivatives d and dd with respect to u at both ends.
Polynomial line_between(double p0, double p1);
Polynomial cubic_between(double p0, double p1, double d0, double d1);
Polynomial quintic_between(double p0, double p1, double d0, double d1, double dd0, double dd1);

struct Extremes {
  double smallest, largest;
};

/// The least and the largest of the Bernstein coefficients of degree five: they enclose the
/// polynomial's values on [0, 1].
Extremes enclosure(const Polynomial& p);

/// The least and the largest value on [0, 1], to rounding: at the ends and at the zeros of the
/// derivative, which are isolated by the zeros of its own derivatives.
Extremes extremes(const Polynomial& p);

/// The largest p(a) - p(b) for a <= b in [0, 1], or `before` - p(b) where that is larger, to
/// rounding: 0 for a polynomial that begins at `before` or above and does not decrease.
double largest_decrease(const Polynomial& p,
                        double before = -std::numeric_limits<double>::infinity());

}  // namespace beeline::internal
