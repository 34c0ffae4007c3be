// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_INVERSE_TRIGONOMETRIC_POLYNOMIAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_INVERSE_TRIGONOMETRIC_POLYNOMIAL_INL_H
#undef BEELINE_INVERSE_TRIGONOMETRIC_POLYNOMIAL_INL_H
#else
#define BEELINE_INVERSE_TRIGONOMETRIC_POLYNOMIAL_INL_H
#endif

#include <algorithm>

#include <beeline/inverse/analytic/trigonometric_polynomial.h>

#include <beeline/simd/trigonometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

using internal::SampleAngles;
using internal::TrigonometricTables;

/// A real trigonometric polynomial, sum of cosine[k] cos kx + sine[k] sin kx.
struct TrigonometricPolynomial {
  int degree;
  double cosine[TrigonometricTables::max_degree + 1], sine[TrigonometricTables::max_degree + 1];
};

/// The zeros of a polynomial in [0, 2 pi), and the minima of its absolute value that may be double
/// zeros.
struct TrigonometricZeros {
  static constexpr int max_count = 32;
  int count = 0;
  double angle[max_count + lane_count];
  bool uncertain[max_count + lane_count] = {};  ///< of a zero that is at a double zero, if real
  int double_count = 0;  ///< number of zeros that are, or may be, double to rounding
  double double_angle[max_count / 2 + lane_count];
};

/// Value and first two derivatives at eight angles.
HWY_INLINE void evaluate(const TrigonometricPolynomial& f, Lanes angle, Lanes* value) {
  Lanes s1, c1;
  sine_cosine(angle, s1, c1);
  Lanes s = s1, c = c1;
  value[0] = Lanes(f.cosine[0]);
  value[1] = value[2] = Lanes(0);
  for (int k = 1; k <= f.degree; ++k) {
    const Lanes term = fma(Lanes(f.cosine[k]), c, Lanes(f.sine[k]) * s);
    const Lanes quadrature = fma(Lanes(f.sine[k]), c, -(Lanes(f.cosine[k]) * s));
    value[0] += term;
    value[1] = fma(Lanes(k), quadrature, value[1]);
    value[2] = fnma(Lanes(k * k), term, value[2]);
    const Lanes next = fma(c, c1, -(s * s1));
    s = fma(s, c1, c * s1);
    c = next;
  }
}

/// Computes the coefficients from values at the sample angles, scaled so that the largest is 1.
/// Returns the largest coefficient beyond `degree`, in this scale. Without rounding it would be
/// zero.
inline double interpolate(const SampleAngles& samples, const double* values, int degree,
                          TrigonometricPolynomial& f) {
  const int n = samples.count;
  f.degree = degree;
  alignas(64) double coefficients[SampleAngles::max_count];
  for (int block = 0; block < n; block += lane_count) {
    Lanes sum(0);
    for (int j = 0; j < n; ++j) {
      sum = fma(Lanes(values[j]), Lanes::load(samples.transform[j] + block), sum);
    }
    sum.store(coefficients + block);
  }
  const double *cosine = coefficients,
               *sine = coefficients + n / 2;  // sine[0] is not the coefficient of a sine
  double largest = 1e-300, beyond = 0;
  for (int k = 0; k <= f.degree; ++k) {
    f.cosine[k] = cosine[k];  // NOLINT(clang-analyzer-core.uninitialized.Assign): all are stored
    f.sine[k] = k > 0 ? sine[k] : 0;
    largest = std::max({largest, std::abs(f.cosine[k]), std::abs(f.sine[k])});
  }
  for (int k = f.degree + 1; k < n / 2; ++k) {
    beyond = std::max({beyond, std::abs(cosine[k]), std::abs(sine[k])});
  }
  for (int k = 0; k <= f.degree; ++k) {
    f.cosine[k] /= largest;
    f.sine[k] /= largest;
  }
  return beyond / largest;
}

/// Value and first two derivatives at an angle.
struct SampledPoint {
  double of[3];
};

/// Values and first two derivatives on the tables' grid, continued periodically by one register.
struct GridValues {
  static constexpr int points = TrigonometricTables::grid;
  alignas(64) double of[3][points + lane_count];
  SampledPoint at(int k) const { return {of[0][k], of[1][k], of[2][k]}; }
};

inline void fill_grid(const TrigonometricTables& tables, const TrigonometricPolynomial& f,
                      GridValues& grid) {
  constexpr int half = GridValues::points / 2;
  double slope_cosine[TrigonometricTables::max_degree + 1];
  double slope_sine[TrigonometricTables::max_degree + 1];
  double square[TrigonometricTables::max_degree + 1];
  for (int k = 1; k <= f.degree; ++k) {
    slope_cosine[k] = k * f.sine[k];
    slope_sine[k] = k * f.cosine[k];
    square[k] = k * k;
  }
  for (int j = 0; j < half; j += lane_count) {
    // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): degree is never negative
    Lanes even[3] = {f.cosine[0], 0, 0}, odd[3] = {0, 0, 0};
    for (int k = 1; k <= f.degree; ++k) {
      const Lanes c = Lanes::load(tables.cosine[k - 1] + j),
                  s = Lanes::load(tables.sine[k - 1] + j);
      const Lanes term = fma(Lanes(f.cosine[k]), c, Lanes(f.sine[k]) * s);
      Lanes* sum = k % 2 == 0 ? even : odd;
      sum[0] += term;
      sum[1] = fma(Lanes(slope_cosine[k]), c, fnma(Lanes(slope_sine[k]), s, sum[1]));
      sum[2] = fnma(Lanes(square[k]), term, sum[2]);
    }
    for (int order = 0; order < 3; ++order) {
      (even[order] + odd[order]).store(grid.of[order] + j);
      (even[order] - odd[order]).store(grid.of[order] + half + j);  // at x + pi
    }
  }
  for (auto& values : grid.of) Lanes::load(values).store(values + 2 * half);
}

constexpr double cell_width = 6.283185307179586477 / GridValues::points;

/// Adds the two zeros around a minimum of |f|, with f approximated by value + curvature x^2 / 2. If
/// the parabola crosses zero, they are its real zeros. Otherwise they are two zeros that rounding
/// may have made complex: Newton's method on the arm's kinematics decides, because candidates that
/// are no solutions do not converge.
inline void add_zeros_at_minimum(double angle, double value, double curvature, double noise,
                                 TrigonometricZeros& zeros) {
  if (zeros.count + 2 > TrigonometricZeros::max_count) return;
  // Radians. Missing a solution is worse than a candidate too many, so these are generous.
  constexpr double max_gap = 0.02;   // max value at which a pair is still tried
  constexpr double separate = 1e-3;  // for closer zeros, the null space has two vectors to rounding
  constexpr double min_offset = 1e-6, max_offset = 0.01;  // offsets from the minimum of a pair
  const double steep = std::max(std::abs(curvature), 1e-300);
  const double gap = std::sqrt(2 * std::abs(value) / steep);
  constexpr double rounding = 1e-15;  // rounding of a sum with coefficients up to 1
  const double uncertainty = std::sqrt(2 * std::max(noise, rounding) / steep);
  const bool crosses = value * curvature < 0;
  if (!crosses && gap > std::max(max_gap, 3 * uncertainty)) return;
  const bool uncertain = !crosses || gap < separate;
  if (uncertain) zeros.double_angle[zeros.double_count++] = angle;
  const double offset = crosses ? gap : std::max(std::min(uncertainty, max_offset), min_offset);
  for (const double sign : {-1.0, 1.0}) {
    zeros.uncertain[zeros.count] = uncertain;
    zeros.angle[zeros.count++] = angle + sign * offset;
  }
}

/// Intervals of the circle, each with one zero of the polynomial or of its derivative.
struct Brackets {
  static constexpr int max_count = 32;
  int count = 0;
  double begin[max_count + lane_count], end[max_count + lane_count];
  bool rising[max_count + lane_count];
  HWY_INLINE void add(double from, double to, bool rises) {
    if (count == max_count) return;
    begin[count] = from;
    end[count] = to;
    rising[count++] = rises;
  }
};

/// Masks of eight intervals: with a zero; with a minimum of |f|; and with possibly more than one of
/// either, which must be subdivided. The last are near zero and have a derivative at an end far
/// from the mean derivative.
struct IntervalKinds {
  unsigned zero, minimum, unclear;
};

/// Classifies the intervals; a and b are value and derivatives at their beginnings and ends. A
/// cubic whose end slopes are within 40 % of the mean slope is monotonic, because its slope, a
/// parabola, has no zero inside. The same bound one derivative higher makes the slope monotonic.
HWY_INLINE IntervalKinds classify(const Lanes* a, const Lanes* b, Lanes width) {
  constexpr double monotonic = 0.4;
  const Lanes zero(0);
  const LaneMask crosses = (a[0] * b[0] < zero) | (a[0] == zero);
  // A minimum at a beginning, with a slope of exactly zero, belongs to the interval before.
  const LaneMask towards = a[0] * a[1] < zero, away = a[0] * b[1] >= zero;
  const Lanes rise = b[0] - a[0], rise_bound = Lanes(monotonic) * abs(rise);
  const LaneMask one_zero =
      (abs(width * a[1] - rise) < rise_bound) & (abs(width * b[1] - rise) < rise_bound);
  const Lanes change = b[1] - a[1], change_bound = Lanes(monotonic) * abs(change);
  const LaneMask one_minimum =
      (abs(width * a[2] - change) < change_bound) & (abs(width * b[2] - change) < change_bound);
  // The end slopes could reach zero and return within the interval.
  const LaneMask near = min(abs(a[0]), abs(b[0])) < width * (abs(a[1]) + abs(b[1]));
  return {bits(crosses), bits(towards & away & !crosses),
          bits((crosses & !one_zero) | ((!crosses) & near & !one_minimum))};
}

/// Classifies an interval in eight parts, and subdivides unclear parts up to `levels` times. Each
/// level is a factor of eight. Adjacent intervals have the same values at their common end: with
/// values that differ by rounding, a zero or a minimum at that angle might be in neither.
inline void bracket_within(const TrigonometricPolynomial& f, double begin, double width,
                           const SampledPoint& at_begin, const SampledPoint& at_end, int levels,
                           Brackets& zeros, Brackets& minima) {
  const double part = width / lane_count;
  double eight[lane_count], value[3][lane_count + 1];
  for (int i = 0; i < lane_count; ++i) eight[i] = begin + i * part;
  Lanes here[3], next[3];
  evaluate(f, Lanes::load(eight), here);
  for (int order = 0; order < 3; ++order) {
    here[order].store(value[order]);
    value[order][0] = at_begin.of[order];
    value[order][lane_count] = at_end.of[order];
    here[order] = Lanes::load(value[order]);
    next[order] = Lanes::load(value[order] + 1);
  }
  const IntervalKinds found = classify(here, next, part);
  const unsigned unclear = levels > 1 ? found.unclear : 0;
  for (unsigned left = found.zero | found.minimum | unclear; left != 0; left &= left - 1) {
    const int i = __builtin_ctz(left);
    if ((unclear >> i & 1) != 0) {
      const SampledPoint from{value[0][i], value[1][i], value[2][i]};
      const SampledPoint to{value[0][i + 1], value[1][i + 1], value[2][i + 1]};
      bracket_within(f, eight[i], part, from, to, levels - 1, zeros, minima);
    } else {
      Brackets& kind = (found.zero >> i & 1) != 0 ? zeros : minima;
      kind.add(eight[i], eight[i] + part, value[0][i] < 0);
    }
  }
}

/// Brackets all zeros and all minima of |f|.
inline void bracket_all(const TrigonometricPolynomial& f, const GridValues& grid, Brackets& zeros,
                        Brackets& minima) {
  constexpr int levels = 3;  // 2 pi / 256 / 8^3 = 5e-5 rad: closer zeros count as double
  for (int j = 0; j < GridValues::points; j += lane_count) {
    Lanes here[3], next[3];
    for (int order = 0; order < 3; ++order) {
      here[order] = Lanes::load(grid.of[order] + j);
      next[order] = Lanes::load(grid.of[order] + j + 1);
    }
    const IntervalKinds found = classify(here, next, cell_width);
    for (unsigned left = found.zero | found.minimum | found.unclear; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      const double begin = (j + i) * cell_width;
      if ((found.unclear >> i & 1) != 0) {
        bracket_within(f, begin, cell_width, grid.at(j + i), grid.at(j + i + 1), levels, zeros,
                       minima);
      } else {
        Brackets& kind = (found.zero >> i & 1) != 0 ? zeros : minima;
        kind.add(begin, begin + cell_width, grid.of[0][j + i] < 0);
      }
    }
  }
}

/// Returns the zeros of the polynomial (order 0) or of its derivative (order 1) in eight brackets,
/// by Newton's method, with bisection if a step would leave the bracket. `value` is as evaluate()
/// returns it there.
HWY_NOINLINE inline Lanes solve_brackets(const TrigonometricPolynomial& f, const Brackets& brackets,
                                         int first, int order, Lanes* value) {
  constexpr int steps = 5;  // from 0.025 rad, the errors of a simple zero square down to rounding
  Lanes low = Lanes::load(brackets.begin + first), high = Lanes::load(brackets.end + first);
  double signs[lane_count];
  for (int i = 0; i < lane_count; ++i) signs[i] = brackets.rising[first + i] ? 1 : -1;
  // At a minimum of |f| below zero the derivative falls.
  const Lanes rising = Lanes(order == 0 ? 1 : -1) * Lanes::load(signs);
  Lanes angle = Lanes(0.5) * (low + high);
  for (int step = 0;; ++step) {
    evaluate(f, angle, value);
    if (step == steps) return angle;
    const Lanes height = value[order] * rising, slope = value[order + 1] * rising;
    const LaneMask below = height < Lanes(0);
    low = choose(below, angle, low);
    high = choose(below, high, angle);
    const Lanes next = angle - height / with_sign(max(abs(slope), Lanes(1e-300)), slope);
    angle = choose((next >= low) & (next <= high), next, Lanes(0.5) * (low + high));
  }
}

/// Repeats the last bracket up to a full register.
inline void pad(Brackets& brackets) {
  for (int k = brackets.count; k % lane_count != 0; ++k) {
    brackets.begin[k] = brackets.begin[brackets.count - 1];
    brackets.end[k] = brackets.end[brackets.count - 1];
    brackets.rising[k] = brackets.rising[brackets.count - 1];
  }
}

/// Computes all zeros. `noise`: the error of the polynomial's values.
inline void find_zeros(const TrigonometricTables& tables, const TrigonometricPolynomial& f,
                       double noise, TrigonometricZeros& zeros) {
  GridValues grid;
  fill_grid(tables, f, grid);
  Brackets crossings, minima;
  bracket_all(f, grid, crossings, minima);
  pad(crossings);
  pad(minima);
  Lanes value[3];
  for (int k = 0; k < crossings.count; k += lane_count) {
    solve_brackets(f, crossings, k, 0, value).store(zeros.angle + k);
  }
  zeros.count = crossings.count;
  for (int k = 0; k < minima.count; k += lane_count) {
    double angles[lane_count], values[lane_count], curvatures[lane_count];
    solve_brackets(f, minima, k, 1, value).store(angles);
    value[0].store(values);
    value[2].store(curvatures);
    for (int i = 0; i < std::min(lane_count, minima.count - k); ++i) {
      add_zeros_at_minimum(angles[i], values[i], curvatures[i], noise, zeros);
    }
  }
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
