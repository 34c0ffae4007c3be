// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_GENERAL_CIRCLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_GENERAL_CIRCLE_INL_H
#undef BEELINE_GENERAL_CIRCLE_INL_H
#else
#define BEELINE_GENERAL_CIRCLE_INL_H
#endif

#include <algorithm>

#include <beeline/inverse/analytic/general_circle.h>

#include <beeline/simd/trigonometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// A real trigonometric polynomial, sum of cosine[k] cos kx + sine[k] sin kx.
struct CirclePolynomial {
  int degree;
  double cosine[CircleTables::max_degree + 1], sine[CircleTables::max_degree + 1];
};

/// Where it is zero, and where it comes near zero without crossing.
struct CircleRoots {
  static constexpr int most = 32;
  int count = 0;
  double angle[most + lane_count];
  int pair_count = 0;  ///< where two zeros are, or may be, so close that they are nearly one
  double pair[most / 2 + lane_count];
};

/// Value and two derivatives.
HWY_NOINLINE static void evaluate(const CirclePolynomial& f, Lanes angle, Lanes* value) {
  Lanes s1, c1;
  sine_cosine(angle, s1, c1);
  Lanes s = s1, c = c1;
  value[0] = Lanes(f.cosine[0]);
  value[1] = value[2] = Lanes(0);
  for (int k = 1; k <= f.degree; ++k) {
    const Lanes part = fma(Lanes(f.cosine[k]), c, Lanes(f.sine[k]) * s);
    const Lanes turned = fma(Lanes(f.sine[k]), c, -(Lanes(f.cosine[k]) * s));
    value[0] += part;
    value[1] = fma(Lanes(k), turned, value[1]);
    value[2] = fnma(Lanes(k * k), part, value[2]);
    const Lanes next = fma(c, c1, -(s * s1));
    s = fma(s, c1, c * s1);
    c = next;
  }
}

/// Coefficients from values at the sample angles. Returns how large those are that should
/// be zero, against the largest.
HWY_INLINE double interpolate(const CircleSamples& samples, const double* values, int degree,
                              CirclePolynomial& f) {
  const int n = samples.count;
  f.degree = degree;
  alignas(64) double coefficients[CircleSamples::most];
  for (int block = 0; block < n; block += lane_count) {
    Lanes sum(0);
    for (int j = 0; j < n; ++j) {
      sum = fma(Lanes(values[j]), Lanes::load(samples.transform[j] + block), sum);
    }
    sum.store(coefficients + block);
  }
  const double *cosine = coefficients, *sine = coefficients + n / 2;  // sine[0] is not one
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

/// Values, slopes and curvatures on the tables' grid, and the first again behind the last.
struct CircleGrid {
  static constexpr int points = CircleTables::grid;
  alignas(64) double of[3][points + lane_count];
};

HWY_NOINLINE static void fill(const CircleTables& tables, const CirclePolynomial& f,
                              CircleGrid& grid) {
  constexpr int half = CircleGrid::points / 2;
  for (int j = 0; j < half; j += lane_count) {
    // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): degree is never negative
    Lanes even[3] = {f.cosine[0], 0, 0}, odd[3] = {0, 0, 0};
    for (int k = 1; k <= f.degree; ++k) {
      const Lanes c = Lanes::load(tables.cosine[k - 1] + j),
                  s = Lanes::load(tables.sine[k - 1] + j);
      const Lanes part = fma(Lanes(f.cosine[k]), c, Lanes(f.sine[k]) * s);
      Lanes* sum = k % 2 == 0 ? even : odd;
      sum[0] += part;
      sum[1] = fma(Lanes(k * f.sine[k]), c, fnma(Lanes(k * f.cosine[k]), s, sum[1]));
      sum[2] = fnma(Lanes(k * k), part, sum[2]);
    }
    for (int order = 0; order < 3; ++order) {
      (even[order] + odd[order]).store(grid.of[order] + j);
      (even[order] - odd[order]).store(grid.of[order] + half + j);  // odd ones change their sign
    }
  }
  for (auto& values : grid.of) Lanes::load(values).store(values + 2 * half);
}

constexpr double cell = 6.283185307179586477 / CircleGrid::points;

/// Adds the two angles around a place where the polynomial is nearest to zero: its zeros, should it
/// cross, or, so far as its error lets that be told, might.
HWY_INLINE void add_touching(double angle, double value, double curvature, double noise,
                             CircleRoots& roots) {
  if (roots.count + 2 > CircleRoots::most) return;
  const double steep = std::max(std::abs(curvature), 1e-300);
  const double apart = std::sqrt(2 * std::abs(value) / steep);
  const double blur = std::sqrt(2 * noise / steep);
  const bool crosses = value * curvature < 0;
  if (!crosses && apart > std::max(0.02, 3 * blur)) return;
  if (!crosses || apart < 1e-3) roots.pair[roots.pair_count++] = angle;
  const double aside = crosses ? apart : std::max(std::min(blur, 0.01), 1e-6);
  for (const double sign : {-1.0, 1.0}) {
    roots.angle[roots.count++] = angle + sign * aside;
  }
}

/// Cells of the circle, or parts of them, by what is in them.
struct Cells {
  static constexpr int most = 32;
  int count = 0;
  double begin[most + lane_count], end[most + lane_count];
  bool rising[most + lane_count];
  HWY_INLINE void add(double from, double to, bool rises) {
    if (count == most) return;
    begin[count] = from;
    end[count] = to;
    rising[count++] = rises;
  }
};

/// Which of eight cells hold a zero, which a least distance from zero, and which may hold more than
/// that: near zero, with a slope or curvature at an end that is not like the mean between the ends.
/// A polynomial of degree three (of slope: four) that passes has no zero of its slope (two) inside.
struct CellKinds {
  unsigned crossing, turning, winding;
};
/// a, b: value, slope and curvature at the beginnings and the ends of the cells.
HWY_INLINE CellKinds kinds(const Lanes* a, const Lanes* b, Lanes width) {
  const Lanes zero(0);
  const LaneMask crosses = (a[0] * b[0] < zero) | (a[0] == zero);
  const LaneMask towards = a[0] * a[1]<zero, away = a[0] * b[1]> zero;
  const Lanes rise = b[0] - a[0], rise_bound = Lanes(0.4) * abs(rise);
  const LaneMask straight =
      (abs(width * a[1] - rise) < rise_bound) & (abs(width * b[1] - rise) < rise_bound);
  const Lanes bend = b[1] - a[1], bend_bound = Lanes(0.4) * abs(bend);
  const LaneMask round =
      (abs(width * a[2] - bend) < bend_bound) & (abs(width * b[2] - bend) < bend_bound);
  // Slopes so steep that they could lead to zero and back within the cell.
  const LaneMask near = min(abs(a[0]), abs(b[0])) < width * (abs(a[1]) + abs(b[1]));
  return {bits(crosses), bits(towards & away & !crosses),
          bits((crosses & !straight) | ((!crosses) & near & !round))};
}

/// Looks at a cell in eight parts, and again at each of these that winds.
inline void sort_parts(const CirclePolynomial& f, double begin, double width, int levels,
                       Cells& crossing, Cells& turning) {
  const double part = width / lane_count;
  double eight[lane_count], value[lane_count];
  for (int i = 0; i < lane_count; ++i) eight[i] = begin + i * part;
  Lanes here[3], next[3];
  evaluate(f, Lanes::load(eight), here);
  evaluate(f, Lanes::load(eight) + Lanes(part), next);
  here[0].store(value);
  const CellKinds found = kinds(here, next, part);
  const unsigned winding = levels > 1 ? found.winding : 0;
  for (unsigned rest = found.crossing | found.turning | winding; rest != 0; rest &= rest - 1) {
    const int i = __builtin_ctz(rest);
    if ((winding >> i & 1) != 0) {
      sort_parts(f, eight[i], part, levels - 1, crossing, turning);
    } else {
      Cells& kind = (found.crossing >> i & 1) != 0 ? crossing : turning;
      kind.add(eight[i], eight[i] + part, value[i] < 0);
    }
  }
}

HWY_NOINLINE static void sort_cells(const CirclePolynomial& f, const CircleGrid& grid,
                                    Cells& crossing, Cells& turning) {
  for (int j = 0; j < CircleGrid::points; j += lane_count) {
    Lanes here[3], next[3];
    for (int order = 0; order < 3; ++order) {
      here[order] = Lanes::load(grid.of[order] + j);
      next[order] = Lanes::load(grid.of[order] + j + 1);
    }
    const CellKinds found = kinds(here, next, cell);
    for (unsigned rest = found.crossing | found.turning | found.winding; rest != 0;
         rest &= rest - 1) {
      const int i = __builtin_ctz(rest);
      const double begin = (j + i) * cell;
      if ((found.winding >> i & 1) != 0) {
        sort_parts(f, begin, cell, 3, crossing, turning);
      } else {
        Cells& kind = (found.crossing >> i & 1) != 0 ? crossing : turning;
        kind.add(begin, begin + cell, grid.of[0][j + i] < 0);
      }
    }
  }
}

/// Zeros of the polynomial (order 0) or of its slope (1), one in each cell, by Newton's method with
/// bisection where it would leave the cell.
HWY_NOINLINE static Lanes find_zeros(const CirclePolynomial& f, const Cells& cells, int k,
                                     int order, int steps, Lanes* value) {
  Lanes low = Lanes::load(cells.begin + k), high = Lanes::load(cells.end + k);
  double signs[lane_count];
  for (int i = 0; i < lane_count; ++i) signs[i] = cells.rising[k + i] ? 1 : -1;
  // A least distance from zero below it is a falling slope's zero.
  const Lanes rising = Lanes(order == 0 ? 1 : -1) * Lanes::load(signs);
  Lanes angle = Lanes(0.5) * (low + high);
  for (int step = 0; step < steps; ++step) {
    evaluate(f, angle, value);
    const Lanes height = value[order] * rising, slope = value[order + 1] * rising;
    const LaneMask below = height < Lanes(0);
    low = choose(below, angle, low);
    high = choose(below, high, angle);
    const Lanes next = angle - height / with_sign(max(abs(slope), Lanes(1e-300)), slope);
    angle = choose((next >= low) & (next <= high), next, Lanes(0.5) * (low + high));
  }
  evaluate(f, angle, value);
  return angle;
}

HWY_INLINE void fill_up(Cells& cells) {
  for (int k = cells.count; k % lane_count != 0; ++k) {
    cells.begin[k] = cells.begin[cells.count - 1];
    cells.end[k] = cells.end[cells.count - 1];
    cells.rising[k] = cells.rising[cells.count - 1];
  }
}

/// `noise`: the error of the polynomial's values against its largest coefficient.
HWY_INLINE void find_roots(const CircleTables& tables, const CirclePolynomial& f, double noise,
                           CircleRoots& roots) {
  CircleGrid grid;
  fill(tables, f, grid);
  Cells crossing, turning;
  sort_cells(f, grid, crossing, turning);
  fill_up(crossing);
  fill_up(turning);
  Lanes value[3];
  for (int k = 0; k < crossing.count; k += lane_count) {
    find_zeros(f, crossing, k, 0, 5, value).store(roots.angle + k);
  }
  roots.count = crossing.count;
  for (int k = 0; k < turning.count; k += lane_count) {
    double angles[lane_count], heights[lane_count], curvatures[lane_count];
    find_zeros(f, turning, k, 1, 5, value).store(angles);
    value[0].store(heights);
    value[2].store(curvatures);
    for (int i = 0; i < std::min(lane_count, turning.count - k); ++i) {
      add_touching(angles[i], heights[i], curvatures[i], noise, roots);
    }
  }
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
