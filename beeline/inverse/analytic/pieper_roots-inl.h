// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_INVERSE_PIEPER_ROOTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_INVERSE_PIEPER_ROOTS_INL_H
#undef BEELINE_INVERSE_PIEPER_ROOTS_INL_H
#else
#define BEELINE_INVERSE_PIEPER_ROOTS_INL_H
#endif

#include <array>
#include <cmath>

#include <beeline/inverse/analytic/quartic.h>

#include <beeline/inverse/analytic/pieper_equations-inl.h>
#include <beeline/simd/geometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// A root counts as zero if its radicand is at most this much below zero, relative. At the
/// workspace boundary rounding determines the sign, especially if several boundaries meet. The
/// check of the residual rejects a root that does not exist, so this may be generous.
inline constexpr double root_slack = 1e-6;

/// The relative radicand below which the two solutions of a root are within about 1e-3 rad.
inline constexpr double nearly_double = 1e-7;

/// The status of each lane while the equations are solved in sequence.
struct LaneStatus {
  LaneMask found;    ///< every equation has a solution, to rounding
  LaneMask free[4];  ///< joint d, e, f or a is free
  LaneMask twin;     ///< another lane has nearly the same solution
  LaneMask weak;     ///< joint e is badly determined
  LaneMask lost;     ///< an equation does not determine a displacement
  LaneMask far;      ///< an equation has no solution, by much more than rounding
  Lanes residual;    ///< error of the loop-closure equation, metres plus radians

  /// Returns the lanes in which some joint is free.
  HWY_INLINE LaneMask continuum() const { return free[0] | free[1] | free[2] | free[3]; }
};

/// Solves n . (cos, sin) + k = 0 (subproblem: rotation to a given height) for the solution of the
/// given sign. If n and k vanish relative to `unit`, the scale of n, every angle solves it: the
/// result is `preferred`, and `free` is set. Sets `twin` if both signs give nearly the same angle.
/// Returns the lanes with a solution.
HWY_INLINE LaneMask solve_rotation(Lanes nx, Lanes ny, Lanes k, Lanes sign, double unit,
                                   const CosSine& preferred, CosSine& unknown, LaneMask& free,
                                   LaneMask& twin) {
  const Lanes nn = fma(nx, nx, ny * ny), kk = k * k;
  const Lanes radicand = nn - kk;
  // A radicand of this relative size is all rounding. Its root would be 1e-7, and would hide that
  // the configuration is singular.
  constexpr double rounding = 1e-14;
  const LaneMask double_root = radicand <= Lanes(rounding) * nn;
  twin = twin | (radicand <= Lanes(nearly_double) * nn);
  const Lanes root = sqrt(choose(double_root, Lanes(0), radicand));
  const double zero = 1e-12 * unit;
  free = (nn <= Lanes(zero * zero)) & (abs(k) <= Lanes(10 * zero));
  const LaneMask vanishes = nn <= Lanes(0);
  const Lanes scale = Lanes(1) / choose(vanishes, Lanes(1), nn);
  const Lanes signed_root = sign * root;
  unknown =
      normalised(-fma(k, nx, signed_root * ny) * scale, fma(signed_root, nx, -(k * ny)) * scale);
  unknown = {choose(free, preferred.c, unknown.c), choose(free, preferred.s, unknown.s)};
  return free | ((radicand >= Lanes(-root_slack) * nn) & !vanishes);
}

/// Solves n1 t + n2 t^2 + k = 0 for the displacement t, as (t, t^2). If n2 = 0 there is one
/// solution, found in the lanes of positive sign. Returns the lanes with a solution.
HWY_INLINE LaneMask solve_displacement(Lanes n1, Lanes n2, Lanes k, Lanes sign, CosSine& unknown,
                                       LaneMask& twin) {
  const Lanes radicand = fma(n1, n1, Lanes(-4) * n2 * k);
  twin = twin | (radicand <= Lanes(nearly_double) * fma(n1, n1, abs(Lanes(4) * n2 * k)));
  const Lanes root = sqrt(max(radicand, Lanes(0)));
  const Lanes half = Lanes(-0.5) * (n1 + with_sign(root, n1));
  const LaneMask linear = n2 == Lanes(0), upper = sign > Lanes(0);
  // The two roots are half / n2 and k / half: neither subtracts nearly equal numbers.
  const LaneMask by_half = upper | linear;
  const Lanes numerator = choose(by_half, k, half), denominator = choose(by_half, half, n2);
  const LaneMask vanishes = denominator == Lanes(0);
  unknown.c = numerator / choose(vanishes, Lanes(1), denominator);
  // At a double root t = 0 both k and half vanish.
  unknown.s = unknown.c * unknown.c;
  const LaneMask real = radicand >= Lanes(-root_slack) * fma(n1, n1, abs(Lanes(4) * n2 * k));
  return real & ((!linear) | upper) & ((!vanishes) | (k == Lanes(0)));
}

/// The values of the first unknown, (cos, sin) or (displacement, its square), two lanes for each
/// root of a quartic.
struct QuarticLanes {
  double c[lane_count] = {}, s[lane_count] = {};
  unsigned found = 0;  ///< lanes with a root
  unsigned twin = 0;   ///< lanes whose root is close to another one
};

/// Sets root number i.
inline void set_root(QuarticLanes& lanes, int i, double c, double s) {
  for (const int lane : {2 * i, 2 * i + 1}) {
    lanes.c[lane] = c;
    lanes.s[lane] = s;
    lanes.found |= 1u << lane;
  }
}

/// Marks roots that are within about 1e-3 rad of each other as twins.
inline void mark_twins(const std::array<double, 4>& roots, int count, QuarticLanes& lanes) {
  constexpr double close = 5e-4;  // of the tangent of half an angle
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < i; ++j) {
      const double a = roots[i], b = roots[j];
      if (std::abs(a - b) <= close * (1 + a * a)) lanes.twin |= 3u << (2 * i) | 3u << (2 * j);
    }
  }
}

/// |m (t, t^2) + n|^2 = det^2 for a displacement t.
inline void displacement_roots(const double (*m)[2], const double* n, double det,
                               QuarticLanes& lanes) {
  std::array<double, 5> quartic{-det * det, 0, 0, 0, 0};
  for (int i = 0; i < 2; ++i) {
    quartic[0] += n[i] * n[i];
    quartic[1] += 2 * n[i] * m[i][0];
    quartic[2] += 2 * n[i] * m[i][1] + m[i][0] * m[i][0];
    quartic[3] += 2 * m[i][0] * m[i][1];
    quartic[4] += m[i][1] * m[i][1];
  }
  std::array<double, 4> roots{};
  const int count = internal::quartic_roots(quartic, roots);
  mark_twins(roots, count, lanes);
  for (int i = 0; i < count; ++i) set_root(lanes, i, roots[i], roots[i] * roots[i]);
}

/// |m (cos, sin) + n|^2 = det^2 for an angle: k0 + k1 c + k2 s + k3 (c^2 - s^2) + 2 k4 c s = 0.
inline void angle_roots(const double (*m)[2], const double* n, double det, QuarticLanes& lanes) {
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
  // The half angle's tangent is infinite at pi. The angle is measured from one of five directions,
  // the one whose opposite is farthest from a root: a quartic has four roots.
  constexpr double directions[5][2] = {
      {1, 0}, {0.28, 0.96}, {-0.8, 0.6}, {-0.8, -0.6}, {0.28, -0.96}};
  const double* zero = directions[0];
  for (const auto& each : directions) {
    if (std::abs(value(-each[0], -each[1])) > std::abs(value(-zero[0], -zero[1]))) zero = each;
  }
  const double x = zero[0], y = zero[1];
  const double j1 = k1 * x + k2 * y, j2 = k2 * x - k1 * y;
  const double j3 = k3 * (x * x - y * y) + 2 * k4 * x * y;
  const double j4 = k4 * (x * x - y * y) - 2 * k3 * x * y;
  const std::array<double, 5> quartic{k0 + j1 + j3, 2 * j2 + 4 * j4, 2 * k0 - 6 * j3,
                                      2 * j2 - 4 * j4, k0 - j1 + j3};
  std::array<double, 4> roots{};
  const int count = quartic[4] == 0 ? 0 : internal::quartic_roots(quartic, roots);
  mark_twins(roots, count, lanes);
  for (int i = 0; i < count; ++i) {
    const double t = roots[i], scale = 1 / (1 + t * t);
    const double cosine = (1 - t * t) * scale, sine = 2 * t * scale;
    set_root(lanes, i, x * cosine - y * sine, y * cosine + x * sine);
  }
}

/// Solves both equations if neither is free of an unknown. They give the rotation `second` as a
/// linear function of `first`. Its length is one, which is a quartic in the displacement or in the
/// tangent of the half angle of `first`.
inline LaneMask solve_quartic(const double (*first)[2], bool prismatic, const double (*second)[2],
                              const double* constant, CosSine& one, CosSine& other,
                              LaneMask& twin) {
  const double det = second[0][0] * second[1][1] - second[0][1] * second[1][0];
  // |det| (second) = |m (first) + n|: each row is a combination of the two equations.
  double m[2][2], n[2];
  for (int j = 0; j < 2; ++j) {
    m[0][j] = second[0][1] * first[1][j] - second[1][1] * first[0][j];
    m[1][j] = second[1][0] * first[0][j] - second[0][0] * first[1][j];
  }
  n[0] = second[0][1] * constant[1] - second[1][1] * constant[0];
  n[1] = second[1][0] * constant[0] - second[0][0] * constant[1];
  QuarticLanes lanes;
  if (prismatic) {
    displacement_roots(m, n, det, lanes);
  } else {
    angle_roots(m, n, det, lanes);
  }
  one = {Lanes::load(lanes.c), Lanes::load(lanes.s)};
  const Lanes x = fma(Lanes(m[0][0]), one.c, fma(Lanes(m[0][1]), one.s, Lanes(n[0])));
  const Lanes y = fma(Lanes(m[1][0]), one.c, fma(Lanes(m[1][1]), one.s, Lanes(n[1])));
  const Lanes square = fma(x, x, y * y);
  twin = twin | mask_of(lanes.twin);
  const LaneMask vanishes = square == Lanes(0);
  const Lanes scale = Lanes(det < 0 ? -1 : 1) / sqrt(choose(vanishes, Lanes(1), square));
  other = {x * scale, y * scale};
  return mask_of(lanes.found) & !vanishes;
}

/// Solves one equation for one unknown, joint 0 or 2 of d, e, f, with the roots of the given signs.
HWY_INLINE LaneMask solve_one(Lanes nx, Lanes ny, Lanes k, int joint, bool prismatic,
                              const double* signs, double unit, const CosSine& preferred,
                              CosSine& unknown, LaneStatus& status) {
  const Lanes sign = Lanes::load(signs);
  if (prismatic) {
    const LaneMask found = solve_displacement(nx, ny, k, sign, unknown, status.twin);
    // If all coefficients vanish, to rounding, any displacement may do.
    constexpr double vanishing = 1e-7;
    const LaneMask any =
        (abs(nx) <= Lanes(vanishing)) & (ny == Lanes(0)) & (abs(k) <= Lanes(vanishing * unit));
    status.lost = status.lost | any;
    return found;
  }
  LaneMask free;
  const LaneMask found =
      solve_rotation(nx, ny, k, sign, unit, preferred, unknown, free, status.twin);
  status.free[joint] = status.free[joint] | free;
  // Coefficients of a thousandth of their scale have lost three of sixteen digits.
  constexpr double beyond = 1e-5, small = 1e-3;
  const Lanes nn = fma(nx, nx, ny * ny);
  // If the other unknown is free, this equation may have a solution for another value of it.
  status.far = status.far | ((fma(k, k, -nn) > Lanes(beyond) * nn) &
                             (nn > Lanes(small * small * unit * unit)) & !status.continuum());
  return found;
}

/// Solves the two equations for joint f (w) and joint d (u): up to four solutions, two lanes each.
/// Bits 2 and 1 of the lane number are the signs of the two roots. Sets status.found.
HWY_INLINE void solve_pieper_equations(const PieperLoop& loop, const PieperEquations& equations,
                                       const CosSine* preferred, CosSine& w, CosSine& u,
                                       LaneStatus& status) {
  alignas(64) static constexpr double first_sign[8] = {1, 1, 1, 1, -1, -1, -1, -1};
  alignas(64) static constexpr double second_sign[8] = {1, 1, -1, -1, 1, 1, -1, -1};
  const double* constant = equations.constant;
  if (loop.first == PieperLoop::First::neither) {
    status.found = loop.prismatic[0]
                       ? solve_quartic(equations.u, true, equations.w, constant, u, w, status.twin)
                       : solve_quartic(equations.w, loop.prismatic[2], equations.u, constant, w, u,
                                       status.twin);
    return;
  }
  const bool w_first = loop.first == PieperLoop::First::w;
  const double(*first)[2] = w_first ? equations.w : equations.u;
  const double(*second)[2] = w_first ? equations.u : equations.w;
  const int first_joint = w_first ? 2 : 0, second_joint = w_first ? 0 : 2;
  CosSine& one = w_first ? w : u;
  CosSine& other = w_first ? u : w;
  const double length = loop.family == PieperLoop::Family::intersecting ? loop.size : 1;
  const double unit[2] = {length, length * loop.size};  // units of the two equations
  const double l0 = loop.weight[0], l1 = loop.weight[1];
  const int e = loop.second;
  const LaneMask found = solve_one(
      Lanes(l0 * first[0][0] + l1 * first[1][0]), Lanes(l0 * first[0][1] + l1 * first[1][1]),
      Lanes(l0 * constant[0] + l1 * constant[1]), first_joint, loop.prismatic[first_joint],
      first_sign, unit[l1 == 0 ? 0 : 1], preferred[first_joint], one, status);
  const Lanes rest = fma(Lanes(first[e][0]), one.c, fma(Lanes(first[e][1]), one.s, constant[e]));
  const LaneMask solved = solve_one(Lanes(second[e][0]), Lanes(second[e][1]), rest, second_joint,
                                    loop.prismatic[second_joint], second_sign, unit[e],
                                    preferred[second_joint], other, status);
  // If the first unknown is free, another of its values may have a solution, which the numerical
  // method searches for.
  status.found = found & (solved | status.free[first_joint]);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
