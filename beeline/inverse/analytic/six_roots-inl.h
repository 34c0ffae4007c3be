// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_INVERSE_SIX_ROOTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_INVERSE_SIX_ROOTS_INL_H
#undef BEELINE_INVERSE_SIX_ROOTS_INL_H
#else
#define BEELINE_INVERSE_SIX_ROOTS_INL_H
#endif

#include <array>
#include <cmath>

#include <beeline/inverse/analytic/quartic.h>

#include <beeline/inverse/analytic/six_pair-inl.h>
#include <beeline/simd/geometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// How far below zero, relative, the square under a root may be for the root to count as zero: at
/// the edge of reach, and more so where several edges meet, rounding decides. What is taken wrongly
/// fails the check of the residual.
inline constexpr double root_slack = 1e-6;

/// The square under a root, relative, below which its two solutions are within about 1e-4 rad.
inline constexpr double nearly_double = 1e-9;

/// The turn with n . (cos, sin) + k = 0 of the sign that is asked for. Where n and k vanish any
/// turn will do: then the preferred one is taken, and `free` is set. `unit` is what n counts
/// against. `twin` is set where the other sign gives nearly the same.
HWY_NOINLINE static LaneMask solve_turn(Lanes nx, Lanes ny, Lanes k, Lanes sign, double unit,
                                        const CosSine& preferred, CosSine& turn, LaneMask& free,
                                        LaneMask& twin) {
  const Lanes nn = fma(nx, nx, ny * ny), kk = k * k;
  const Lanes under = nn - kk;
  // A root that rounding alone would make is none, so that what is singular there is seen to be.
  constexpr double rounding = 1e-14;
  const LaneMask double_root = under <= Lanes(rounding) * nn;
  twin = twin | (under <= Lanes(nearly_double) * nn);
  const Lanes root = sqrt(choose(double_root, Lanes(0), under));
  const double nothing = 1e-12 * unit;
  free = (nn <= Lanes(nothing * nothing)) & (abs(k) <= Lanes(10 * nothing));
  const LaneMask vanishes = nn <= Lanes(0);
  const Lanes scale = Lanes(1) / choose(vanishes, Lanes(1), nn);
  const Lanes signed_root = sign * root;
  turn = normalised(-fma(k, nx, signed_root * ny) * scale, fma(signed_root, nx, -(k * ny)) * scale);
  turn = {choose(free, preferred.c, turn.c), choose(free, preferred.s, turn.s)};
  return free | ((under >= Lanes(-root_slack) * nn) & !vanishes);
}

/// The travel t with n1 t + n2 t^2 + k = 0, as (t, t^2). Where n2 vanishes there is one, of sign 1.
HWY_INLINE LaneMask solve_slide(Lanes n1, Lanes n2, Lanes k, Lanes sign, CosSine& turn,
                                LaneMask& twin) {
  const Lanes under = fma(n1, n1, Lanes(-4) * n2 * k);
  twin = twin | (under <= Lanes(nearly_double) * fma(n1, n1, abs(Lanes(4) * n2 * k)));
  const Lanes root = sqrt(max(under, Lanes(0)));
  const Lanes half = Lanes(-0.5) * (n1 + with_sign(root, n1));
  const LaneMask straight = n2 == Lanes(0), upper = sign > Lanes(0);
  // The two roots half / n2 and k / half: neither loses digits.
  const LaneMask by_half = upper | straight;
  const Lanes over = choose(by_half, k, half), below = choose(by_half, half, n2);
  const LaneMask vanishes = below == Lanes(0);
  turn.c = over / choose(vanishes, Lanes(1), below);
  // A double root at zero travel is one: k and half both vanish.
  turn.s = turn.c * turn.c;
  const LaneMask real = under >= Lanes(-root_slack) * fma(n1, n1, abs(Lanes(4) * n2 * k));
  return real & ((!straight) | upper) & ((!vanishes) | (k == Lanes(0)));
}

/// The two equations where neither is free of an unknown: the turn `second` is linear in `first`,
/// and has length one. That is a quartic, of the half angle's tangent or of the travel.
HWY_NOINLINE static LaneMask solve_quartic(const double (*first)[2], bool slides,
                                           const double (*second)[2], const double* rest,
                                           CosSine& one, CosSine& other, LaneMask& twin) {
  const double det = second[0][0] * second[1][1] - second[0][1] * second[1][0];
  // |det| (second turn) = |m (first) + n|: each row is a combination of the two equations.
  double m[2][2], n[2];
  for (int j = 0; j < 2; ++j) {
    m[0][j] = second[0][1] * first[1][j] - second[1][1] * first[0][j];
    m[1][j] = second[1][0] * first[0][j] - second[0][0] * first[1][j];
  }
  n[0] = second[0][1] * rest[1] - second[1][1] * rest[0];
  n[1] = second[1][0] * rest[0] - second[0][0] * rest[1];
  double c[lane_count] = {}, s[lane_count] = {};
  unsigned found = 0, close = 0;
  std::array<double, 4> roots{};
  const auto compare = [&](int count) {
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < i; ++j) {
        const double a = roots[i], b = roots[j];
        constexpr double near = 1e-4;
        if (std::abs(a - b) <= near * (1 + a * a)) close |= 3u << (2 * i) | 3u << (2 * j);
      }
    }
  };
  if (slides) {
    std::array<double, 5> quartic{-det * det, 0, 0, 0, 0};
    for (int i = 0; i < 2; ++i) {
      quartic[0] += n[i] * n[i];
      quartic[1] += 2 * n[i] * m[i][0];
      quartic[2] += 2 * n[i] * m[i][1] + m[i][0] * m[i][0];
      quartic[3] += 2 * m[i][0] * m[i][1];
      quartic[4] += m[i][1] * m[i][1];
    }
    const int count = quartic_roots(quartic, roots);
    compare(count);
    for (int i = 0; i < count; ++i) {
      const double t = roots[i];
      c[2 * i] = c[2 * i + 1] = t;
      s[2 * i] = s[2 * i + 1] = t * t;
      found |= 3u << (2 * i);
    }
  } else {
    // f = k0 + k1 c + k2 s + k3 (c^2 - s^2) + 2 k4 c s, read from an angle whose opposite is no
    // root, as the half angle's tangent has no value there.
    const double k0 =
        n[0] * n[0] + n[1] * n[1] - det * det +
        (m[0][0] * m[0][0] + m[1][0] * m[1][0] + m[0][1] * m[0][1] + m[1][1] * m[1][1]) / 2;
    const double k1 = 2 * (m[0][0] * n[0] + m[1][0] * n[1]);
    const double k2 = 2 * (m[0][1] * n[0] + m[1][1] * n[1]);
    const double k3 =
        (m[0][0] * m[0][0] + m[1][0] * m[1][0] - m[0][1] * m[0][1] - m[1][1] * m[1][1]) / 2;
    const double k4 = m[0][0] * m[0][1] + m[1][0] * m[1][1];
    const auto value = [&](double x, double y) HWY_ATTR {
      return k0 + k1 * x + k2 * y + k3 * (x * x - y * y) + 2 * k4 * x * y;
    };
    constexpr double places[5][2] = {
        {1, 0}, {0.28, 0.96}, {-0.8, 0.6}, {-0.8, -0.6}, {0.28, -0.96}};
    const double* at = places[0];
    for (const auto& place : places) {
      if (std::abs(value(-place[0], -place[1])) > std::abs(value(-at[0], -at[1]))) at = place;
    }
    const double x = at[0], y = at[1];
    const double j1 = k1 * x + k2 * y, j2 = k2 * x - k1 * y;
    const double j3 = k3 * (x * x - y * y) + 2 * k4 * x * y;
    const double j4 = k4 * (x * x - y * y) - 2 * k3 * x * y;
    const std::array<double, 5> quartic{k0 + j1 + j3, 2 * j2 + 4 * j4, 2 * k0 - 6 * j3,
                                        2 * j2 - 4 * j4, k0 - j1 + j3};
    const int count = quartic[4] == 0 ? 0 : quartic_roots(quartic, roots);
    compare(count);
    for (int i = 0; i < count; ++i) {
      const double t = roots[i], size = 1 / (1 + t * t);
      const double cosine = (1 - t * t) * size, sine = 2 * t * size;
      c[2 * i] = c[2 * i + 1] = x * cosine - y * sine;
      s[2 * i] = s[2 * i + 1] = y * cosine + x * sine;
      found |= 3u << (2 * i);
    }
  }
  one = {Lanes::load(c), Lanes::load(s)};
  const Lanes x = fma(Lanes(m[0][0]), one.c, fma(Lanes(m[0][1]), one.s, Lanes(n[0])));
  const Lanes y = fma(Lanes(m[1][0]), one.c, fma(Lanes(m[1][1]), one.s, Lanes(n[1])));
  const Lanes square = fma(x, x, y * y);
  twin = twin | mask_of(close);
  const LaneMask vanishes = square == Lanes(0);
  const Lanes scale = Lanes(det < 0 ? -1 : 1) / sqrt(choose(vanishes, Lanes(1), square));
  other = {x * scale, y * scale};
  return mask_of(found) & !vanishes;
}

HWY_NOINLINE static LaneMask solve_one(Lanes nx, Lanes ny, Lanes k, bool slides,
                                       const double* signs, double unit, const CosSine& preferred,
                                       CosSine& turn, LaneMask& continuum, LaneMask& twin) {
  const Lanes sign = Lanes::load(signs);
  if (slides) return solve_slide(nx, ny, k, sign, turn, twin);
  LaneMask free;
  const LaneMask found = solve_turn(nx, ny, k, sign, unit, preferred, turn, free, twin);
  continuum = continuum | free;
  return found;
}

/// All pairs of joint f (w) and joint d (u) that satisfy both equations, two lanes for each: the
/// lanes' numbers in binary are the branches.
HWY_INLINE LaneMask six_roots(const SixLoop& loop, const SixPair& pair, const CosSine* preferred,
                              CosSine& w, CosSine& u, LaneMask& continuum, LaneMask& twin) {
  alignas(64) static constexpr double first_sign[8] = {1, 1, 1, 1, -1, -1, -1, -1};
  alignas(64) static constexpr double second_sign[8] = {1, 1, -1, -1, 1, 1, -1, -1};
  if (loop.first == SixLoop::First::neither) {
    return loop.slides[0] ? solve_quartic(pair.u, true, pair.w, pair.rest, u, w, twin)
                          : solve_quartic(pair.w, loop.slides[2], pair.u, pair.rest, w, u, twin);
  }
  const bool w_first = loop.first == SixLoop::First::w;
  const double(*first)[2] = w_first ? pair.w : pair.u;
  const double(*second)[2] = w_first ? pair.u : pair.w;
  const std::size_t joint_one = w_first ? 2 : 0, joint_other = w_first ? 0 : 2;
  CosSine& one = w_first ? w : u;
  CosSine& other = w_first ? u : w;
  const double length = loop.family == SixLoop::Family::meeting ? loop.size : 1;
  const double unit[2] = {length, length * loop.size};  // what the equations count in
  const double l0 = loop.weight[0], l1 = loop.weight[1];
  const int e = loop.second;
  const LaneMask found = solve_one(
      Lanes(l0 * first[0][0] + l1 * first[1][0]), Lanes(l0 * first[0][1] + l1 * first[1][1]),
      Lanes(l0 * pair.rest[0] + l1 * pair.rest[1]), loop.slides[joint_one], first_sign,
      unit[l1 == 0 ? 0 : 1], preferred[joint_one], one, continuum, twin);
  const Lanes rest = fma(Lanes(first[e][0]), one.c, fma(Lanes(first[e][1]), one.s, pair.rest[e]));
  return found & solve_one(Lanes(second[e][0]), Lanes(second[e][1]), rest, loop.slides[joint_other],
                           second_sign, unit[e], preferred[joint_other], other, continuum, twin);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
