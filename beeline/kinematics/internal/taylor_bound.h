#pragma once

#include <array>
#include <cstddef>

namespace beeline::internal {

/// Bounds on the Taylor coefficients of a function f of one variable, at every point of an
/// interval: c[n] >= |f^(n)| / n! for n up to 6, in some norm.
struct TaylorBound {
  static constexpr std::size_t terms = 7;
  std::array<double, terms> c{};

  TaylorBound& operator+=(const TaylorBound& other) {
    for (std::size_t n = 0; n < terms; ++n) c[n] += other.c[n];
    return *this;
  }
};

/// The bounds of a sum, of a multiple by k >= 0, and of a product (Leibniz's rule).
TaylorBound operator+(TaylorBound a, const TaylorBound& b);
TaylorBound operator*(double k, TaylorBound a);
TaylorBound operator*(const TaylorBound& a, const TaylorBound& b);

/// Bounds a rotation exp([r]x), in the operator norm, given bounds of the rotation vector r. r.c[0]
/// has no influence: with r = r0 + d, the Dyson series about exp([r0]x) has terms of norm |d|^m /
/// m! at most. Also bounds a product of rotations, given the sum of the rotation vectors' bounds.
TaylorBound exponential(const TaylorBound& r);

/// The bounds of f(s(t)), where `f` bounds f over the range of s, and `s` bounds s(t).
TaylorBound composed(const TaylorBound& f, const TaylorBound& s);

}  // namespace beeline::internal
