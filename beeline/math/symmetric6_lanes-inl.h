// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_MATH_SYMMETRIC6_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_MATH_SYMMETRIC6_LANES_INL_H
#undef BEELINE_MATH_SYMMETRIC6_LANES_INL_H
#else
#define BEELINE_MATH_SYMMETRIC6_LANES_INL_H
#endif

#include <beeline/simd/lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// Eight symmetric 6x6 matrices, one in each lane: the lower triangle, row by row. For one matrix
/// see damped_least_squares.h.
struct Symmetric6 {
  Lanes entry[21];

  HWY_INLINE Lanes& at(int i, int j) { return entry[i * (i + 1) / 2 + j]; }
};

/// a += c c^T.
HWY_INLINE void add_square(Symmetric6& a, const Lanes (&c)[6]) {
#pragma GCC unroll 6
  for (int i = 0; i < 6; ++i) {
#pragma GCC unroll 6
    for (int j = 0; j <= i; ++j) a.at(i, j) = fma(c[i], c[j], a.at(i, j));
  }
}

/// Solves (a + damping I) x = y by the factorisation L D L^T without pivoting; x replaces y, the
/// factors replace a. `a` is positive semidefinite, so in exact arithmetic no pivot is below the
/// damping; the same bound holds them against rounding. (2x2 pivots would save divisions, but their
/// inverses lose all digits where a is rank deficient.)
HWY_INLINE void solve_damped(Symmetric6& a, Lanes damping, Lanes (&y)[6]) {
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    const Lanes pivot = Lanes(1) / max(a.at(j, j) + damping, damping);
    a.at(j, j) = pivot;
    Lanes scaled[6];
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) {
      scaled[i] = a.at(i, j) * pivot;
      y[i] = fnma(scaled[i], y[j], y[i]);
#pragma GCC unroll 6
      for (int k = j + 1; k <= i; ++k) a.at(i, k) = fnma(scaled[i], a.at(k, j), a.at(i, k));
    }
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) a.at(i, j) = scaled[i];
  }
#pragma GCC unroll 6
  for (int j = 5; j >= 0; --j) {
    y[j] *= a.at(j, j);
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) y[j] = fnma(a.at(i, j), y[i], y[j]);
  }
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
