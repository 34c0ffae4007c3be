#pragma once

#include <array>

namespace beeline::internal {

/// The quintic Hermite polynomial p(u) = p(0) + c[0] u + c[1] u^2 + ... + c[4] u^5 for u from 0 to
/// 1: it has given first and second derivatives at both ends. `Value` is a number or an Eigen
/// vector.
template <class Value>
struct Quintic {
  std::array<Value, 5> c;

  /// p(u) - p(0), and the derivatives of p with respect to u.
  Value change(double u) const {
    return u * (c[0] + u * (c[1] + u * (c[2] + u * (c[3] + u * c[4]))));
  }
  Value first(double u) const {
    return c[0] + u * (2 * c[1] + u * (3 * c[2] + u * (4 * c[3] + u * 5 * c[4])));
  }
  Value second(double u) const {
    return 2 * c[1] + u * (6 * c[2] + u * (12 * c[3] + u * 20 * c[4]));
  }
  Value third(double u) const { return 6 * c[2] + u * (24 * c[3] + u * 60 * c[4]); }
};

/// The quintic with p(1) - p(0) = change, p'(0) = d0, p''(0) = dd0, p'(1) = d1, p''(1) = dd1.
template <class Value>
Quintic<Value> quintic_between(const Value& change, const Value& d0, const Value& dd0,
                               const Value& d1, const Value& dd1) {
  const Value half = 0.5 * dd0;
  const Value r0 = change - d0 - half;  // what u^3, u^4 and u^5 contribute at u = 1
  const Value r1 = d1 - d0 - dd0;       // and to p'
  const Value r2 = dd1 - dd0;           // and to p''
  return {
      {d0, half, 10 * r0 - 4 * r1 + 0.5 * r2, -15 * r0 + 7 * r1 - r2, 6 * r0 - 3 * r1 + 0.5 * r2}};
}

/// The rest-to-rest quintic 10 u^3 - 15 u^4 + 6 u^5, which increases from 0 to 1 with first and
/// second derivatives zero at both ends, and its derivatives with respect to u.
struct RestToRest {
  double value, first, second, third;
};
constexpr RestToRest rest_to_rest(double u) {
  const double v = 1 - u;
  return {u * u * u * (10 + u * (-15 + 6 * u)), 30 * u * u * v * v, 60 * u * v * (v - u),
          60 * (1 - 6 * u * v)};
}

}  // namespace beeline::internal
