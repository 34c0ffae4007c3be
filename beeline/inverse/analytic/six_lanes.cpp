#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/inverse/analytic/quartic.h>
#include <beeline/inverse/analytic/six_lanes.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/analytic/six_lanes.cpp"
#include <hwy/foreach_target.h>  // before what is compiled for each target

#include <beeline/inverse/analytic/six_motion-inl.h>
#include <beeline/inverse/analytic/six_pair-inl.h>
#include <beeline/inverse/analytic/six_roots-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

// The branches: one sign for each of three square roots.
alignas(64) constexpr double third_sign[8] = {1, -1, 1, -1, 1, -1, 1, -1};

/// Where a lane stands.
struct Standing {
  LaneMask found;
  LaneMask continuum;
  LaneMask twin;
  LaneMask weak;
  Lanes residual;
};

/// The turn that takes (ax, ay) to (bx, by) in direction. Where either has no length any turn will
/// do, and `free` is set; `weak` where they are so short that the turn is known badly.
HWY_INLINE CosSine turn_between(Lanes ax, Lanes ay, Lanes bx, Lanes by, double nothing,
                                LaneMask& free, double little = 0, LaneMask* weak = nullptr) {
  const Lanes c = fma(ax, bx, ay * by), s = fma(ax, by, -(ay * bx));
  const Lanes square = fma(c, c, s * s);
  free = square <= Lanes(nothing * nothing);
  if (weak != nullptr) *weak = square <= Lanes(little * little);
  const Lanes scale = Lanes(1) / sqrt(choose(free, Lanes(1), square));
  return {choose(free, Lanes(1), c * scale), choose(free, Lanes(0), s * scale)};
}

/// The goal's inverse as the motion that closes the loop: tool * goal^-1 * base.
HWY_INLINE Rigid closing_motion(const SixLoop& loop, const double* goal) {
  Rigid inverse{}, part, whole;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) inverse.rotation[i][j] = goal[4 * j + i];
    for (int j = 0; j < 3; ++j) inverse.translation[i] -= goal[4 * j + i] * goal[4 * j + 3];
  }
  multiply(loop.tool, inverse, part);
  multiply(part, loop.base, whole);
  return whole;
}

/// Joints a, b, c whose axes meet, from the rotation that they have to make together, all of them
/// about the same point: `to` is R_a R_b R_c. With alpha and gamma the angles between the axes, the
/// z axis of `to` has the height cos(alpha) cos(gamma) - sin(alpha) sin(gamma) cos(b). Where the
/// outer axes are nearly in line that says little about b, and the z axis's way aside says it well.
HWY_NOINLINE void solve_meeting(const SixLoop& loop, const LanePose& to, Lanes sign,
                                const CosSine& preferred, CosSine* turn, Standing& standing) {
  const double sa = loop.sin_alpha[0], ca = loop.cos_alpha[0];
  const double sc = loop.sin_alpha[1], cc = loop.cos_alpha[1];
  const double sum = ca * cc - sa * sc, difference = ca * cc + sa * sc;
  const Lanes height = to.z.z;
  const Lanes aside = fma(to.z.x, to.z.x, to.z.y * to.z.y);
  const LaneMask up = height > Lanes(0);
  const Lanes other = aside / (Lanes(1) + abs(height));  // 1 - |height|, but exact
  const Lanes above = choose(up, Lanes(1 - sum) - other, other - Lanes(1 + sum));
  const Lanes below = choose(up, other - Lanes(1 - difference), Lanes(1 + difference) - other);
  // above = height - sum and below = difference - height: together 2 sin(alpha) sin(gamma).
  const double scale = 1 / (2 * sa * sc);
  const Lanes product = above * below;
  // Where a share was free another choice may be within reach: that is for others to find.
  standing.found = standing.found & ((product >= Lanes(-root_slack)) | standing.continuum);
  standing.twin = standing.twin | (product <= Lanes(nearly_double));
  turn[1].c = min(max((below - above) * Lanes(scale), Lanes(-1)), Lanes(1));
  turn[1].s = sign * sqrt(max(product, Lanes(0))) * Lanes(std::abs(2 * scale));

  const Lanes vx = Lanes(sc) * turn[1].s;
  const Lanes vy = -fma(Lanes(ca * sc), turn[1].c, Lanes(sa * cc));
  LaneMask free;
  constexpr double in_line = 1e-12;  // below, b says nothing about how a and c share the turn
  turn[0] = turn_between(vx, vy, to.z.x, to.z.y, in_line * in_line, free);
  turn[0] = {choose(free, preferred.c, turn[0].c), choose(free, preferred.s, turn[0].s)};
  standing.continuum = standing.continuum | (free & standing.found);

  LanePose got = rotated_z(LanePose::identity(), turn[0]);
  got = rotated_z(rotated_x(got, ca, sa), turn[1]);
  got = rotated_x(got, cc, sc);
  // What is left for c, from the whole rotation: right however near a and c are to being in line.
  Lanes c = dot(got.x, to.x) + dot(got.y, to.y), s = dot(got.y, to.x) - dot(got.x, to.y);
  turn[2] = normalised(c * Lanes(0.5), s * Lanes(0.5));
  got = rotated_z(got, turn[2]);
  standing.residual = norm1(got.x - to.x) + norm1(got.z - to.z) + norm1(to.origin);
}

/// Joints a, b, c with parallel axes: a planar arm of three joints, and the motion `to` that they
/// have to make together.
HWY_NOINLINE void solve_parallel(const SixLoop& loop, const LanePose& to, Lanes sign,
                                 const CosSine& preferred, CosSine* turn, Standing& standing) {
  const double* ab = loop.before[4].translation;
  const double* bc = loop.before[5].translation;
  const Lanes x = to.origin.x, y = to.origin.y;
  const Lanes stretch =
      Lanes(0.5) *
      (fma(x, x, y * y) - Lanes(ab[0] * ab[0] + ab[1] * ab[1] + bc[0] * bc[0] + bc[1] * bc[1]));
  LaneMask free;
  const LaneMask reached =
      solve_turn(Lanes(ab[0] * bc[0] + ab[1] * bc[1]), Lanes(ab[1] * bc[0] - ab[0] * bc[1]),
                 -stretch, sign, loop.size * loop.size, preferred, turn[1], free, standing.twin);
  standing.found = standing.found & (reached | standing.continuum);
  standing.continuum = standing.continuum | (free & standing.found);
  const Lanes reach_x = Lanes(ab[0]) + fma(turn[1].c, Lanes(bc[0]), -(turn[1].s * Lanes(bc[1])));
  const Lanes reach_y = Lanes(ab[1]) + fma(turn[1].s, Lanes(bc[0]), turn[1].c * Lanes(bc[1]));
  turn[0] = turn_between(reach_x, reach_y, x, y, 1e-14 * loop.size * loop.size, free);
  turn[0] = {choose(free, preferred.c, turn[0].c), choose(free, preferred.s, turn[0].s)};
  standing.continuum = standing.continuum | (free & standing.found);
  turn[2] = difference(difference({to.x.x, to.x.y}, turn[0]), turn[1]);
  turn[2] = normalised(turn[2].c, turn[2].s);
  standing.residual = abs(x - fma(turn[0].c, reach_x, -(turn[0].s * reach_y))) +
                      abs(y - fma(turn[0].s, reach_x, turn[0].c * reach_y)) +
                      abs(to.origin.z - Lanes(loop.height)) + abs(to.z.x) + abs(to.z.y);
}

/// Turns to coordinates, by the whole turns that bring them nearest to the seed within limits.
HWY_NOINLINE void to_coordinates(const SixLoop& loop, const SixQuestion& question,
                                 const CosSine* turn, SixBranches& branches) {
  Lanes distance(0), excess(0);
  for (int i = 0; i < 6; ++i) {
    const int k = loop.order[i];
    const bool slides = i < 3 && loop.slides[i];
    const Lanes value = slides ? turn[i].c : arc_tangent(turn[i].s, turn[i].c);
    Lanes q = (value - Lanes(loop.rest[i])) * Lanes(loop.sign[i]);
    const Lanes seed(question.seed[k]), lower(question.lower[k]), upper(question.upper[k]);
    constexpr double rounding = 1e-11;  // what a limit may be missed by without harm
    if (question.wraps[k]) {
      constexpr double whole = 0x1.921fb54442d18p+2;
      const Lanes most = floor((upper + Lanes(rounding) - q) * Lanes(1 / whole));
      const Lanes least = ceil((lower - Lanes(rounding) - q) * Lanes(1 / whole));
      // Where no turn is within limits, `least` is one above `most`, and is taken.
      const Lanes turns = max(min(round((seed - q) * Lanes(1 / whole)), most), least);
      q = fma(turns, Lanes(whole), q);
    }
    const Lanes on_bound = min(max(q, lower), upper);
    const LaneMask inside = abs(on_bound - q) <= Lanes(rounding);
    q = choose(inside, on_bound, q);
    excess = excess + abs(on_bound - q);
    distance = fma(q - seed, q - seed, distance);
    q.store(branches.q[k]);
  }
  distance.store(branches.distance);
  excess.store(branches.excess);
  branches.within = branches.found & bits(excess == Lanes(0));
}

void six_branches_kernel(const SixLoop& loop, const SixQuestion& question, SixBranches& branches) {
  Rigid k[4];
  for (std::size_t i = 0; i < 4; ++i) {
    if (static_cast<int>(i) != loop.goal_place) k[i] = loop.before[i];
  }
  k[loop.goal_place] = closing_motion(loop, question.world_T_tool);
  const SixPair pair = six_pair(loop, k);

  CosSine preferred[6];
  for (std::size_t i = 0; i < 6; ++i) preferred[i] = {Lanes(1), Lanes(0)};
  const auto prefer = [&] HWY_ATTR {  // costs six sines, and is rarely needed
    for (std::size_t i = 0; i < 6; ++i) {
      const double angle = loop.sign[i] * question.seed[loop.order[i]] + loop.rest[i];
      preferred[i] = {Lanes(std::cos(angle)), Lanes(std::sin(angle))};
    }
  };
  CosSine turn[6];
  Standing standing;
  for (int pass = 0; pass < 2; ++pass) {
    standing.continuum = standing.twin = Lanes(1) < Lanes(0);
    standing.found =
        six_roots(loop, pair, preferred, turn[2], turn[0], standing.continuum, standing.twin);

    // Joint e turns what lies beyond it to where it is seen from before it.
    const bool points = loop.family == SixLoop::Family::meeting;
    const Vector beyond = moved(k[2], after_joint(pair.p, turn[2], loop.slides[2], points), points);
    const Vector seen =
        moved_back(k[1], before_joint(pair.x, turn[0], loop.slides[0], points), points);
    LaneMask free;
    const double nothing = points ? 1e-12 * loop.size : 1e-12;
    const double little = points ? 1e-5 * loop.size : 1e-5;
    turn[1] = turn_between(beyond.x, beyond.y, seen.x, seen.y, nothing * nothing, free,
                           little * little, &standing.weak);
    turn[1] = {choose(free, preferred[1].c, turn[1].c), choose(free, preferred[1].s, turn[1].s)};
    standing.continuum = standing.continuum | (free & standing.found);

    LanePose whole = after(space(k[0]), turn[0], loop.slides[0]);
    whole = after(times(whole, k[1]), turn[1], false);
    whole = after(times(whole, k[2]), turn[2], loop.slides[2]);
    const LanePose to = inverse(times(whole, k[3]));
    const Lanes sign = Lanes::load(third_sign);
    if (points) {
      solve_meeting(loop, to, sign, preferred[3], turn + 3, standing);
    } else {
      solve_parallel(loop, to, sign, preferred[3], turn + 3, standing);
    }
    if (HWY_LIKELY(pass == 1 || bits(standing.continuum) == 0)) break;
    prefer();
  }
  branches.found = bits(standing.found);
  branches.continuum = bits(standing.continuum & standing.found);
  branches.weak = bits(standing.weak & !standing.found);
  branches.twin = bits(standing.twin & standing.found);
  standing.residual.store(branches.residual);
  to_coordinates(loop, question, turn, branches);
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(six_branches_kernel);

void six_branches(const SixLoop& loop, const SixQuestion& question, SixBranches& branches) {
  HWY_DYNAMIC_DISPATCH(six_branches_kernel)(loop, question, branches);
}

}  // namespace beeline
#endif
