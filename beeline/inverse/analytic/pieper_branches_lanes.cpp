#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/inverse/analytic/pieper_branches.h>
#include <beeline/inverse/analytic/quartic.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/analytic/pieper_branches_lanes.cpp"
#include <beeline/math/revolution.h>

#include <hwy/foreach_target.h>  // before what is compiled for each target

#include <beeline/inverse/analytic/pieper_equations-inl.h>
#include <beeline/inverse/analytic/pieper_roots-inl.h>
#include <beeline/inverse/analytic/rigid_motion-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using internal::PieperBranches;
using internal::PieperRequest;

// Bit 0 of the lane number is the sign of the third root.
alignas(64) constexpr double third_sign[8] = {1, -1, 1, -1, 1, -1, 1, -1};

/// Returns the rotation that takes the direction (ax, ay) to (bx, by). If a length vanishes, every
/// rotation does: the result is the identity, and `free` is set. Sets `weak` if the lengths are so
/// small that the rotation is badly determined.
HWY_INLINE CosSine rotation_between(Lanes ax, Lanes ay, Lanes bx, Lanes by, double zero,
                                    LaneMask& free, double small = 0, LaneMask* weak = nullptr) {
  const Lanes c = fma(ax, bx, ay * by), s = fma(ax, by, -(ay * bx));
  const Lanes square = fma(c, c, s * s);
  free = square <= Lanes(zero * zero);
  if (weak != nullptr) *weak = square <= Lanes(small * small);
  const Lanes scale = Lanes(1) / sqrt(choose(free, Lanes(1), square));
  return {choose(free, Lanes(1), c * scale), choose(free, Lanes(0), s * scale)};
}

/// Returns the K that depends on the goal: tool * goal^-1 * base.
HWY_INLINE RigidMotion closing_motion(const PieperLoop& loop, const double* goal) {
  RigidMotion inverse{}, part, whole;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) inverse.rotation[i][j] = goal[4 * j + i];
    for (int j = 0; j < 3; ++j) inverse.translation[i] -= goal[4 * j + i] * goal[4 * j + 3];
  }
  multiply(loop.tool, inverse, part);
  multiply(part, loop.base, whole);
  return whole;
}

/// Solves joints a, b, c of intersecting axes from the motion `to` = J_a K_b J_b K_c J_c, a
/// rotation about their common point. With alpha, gamma the angles between the axes, the z
/// component of the third axis is cos(alpha) cos(gamma) - sin(alpha) sin(gamma) cos(b). Near its
/// extremes, where the outer axes are nearly parallel, b is computed from the axis's other
/// components, which determine it better.
HWY_INLINE void solve_intersecting(const PieperLoop& loop, const LanePose& to, Lanes sign,
                                   const CosSine& preferred, CosSine* joint, LaneStatus& status) {
  const double sa = loop.sin_alpha[0], ca = loop.cos_alpha[0];
  const double sc = loop.sin_alpha[1], cc = loop.cos_alpha[1];
  const double sum = ca * cc - sa * sc, difference = ca * cc + sa * sc;
  const Lanes height = to.z.z;
  const Lanes planar_square = fma(to.z.x, to.z.x, to.z.y * to.z.y);
  const LaneMask up = height > Lanes(0);
  const Lanes other = planar_square / (Lanes(1) + abs(height));  // 1 - |height|, to full precision
  const Lanes above = choose(up, Lanes(1 - sum) - other, other - Lanes(1 + sum));
  const Lanes below = choose(up, other - Lanes(1 - difference), Lanes(1 + difference) - other);
  // above = height - sum, below = difference - height; their sum is 2 sin(alpha) sin(gamma).
  const double scale = 1 / (2 * sa * sc);
  const Lanes product = above * below;
  // If a previous joint was free, another of its values may have a solution, which the numerical
  // method searches for.
  status.found = status.found & ((product >= Lanes(-root_slack)) | status.continuum());
  status.twin = status.twin | (product <= Lanes(nearly_double));
  joint[1].c = min(max((below - above) * Lanes(scale), Lanes(-1)), Lanes(1));
  joint[1].s = sign * sqrt(max(product, Lanes(0))) * Lanes(std::abs(2 * scale));

  const Lanes vx = Lanes(sc) * joint[1].s;
  const Lanes vy = -fma(Lanes(ca * sc), joint[1].c, Lanes(sa * cc));
  LaneMask free;
  // Sine between axes a and c below which only a + c is determined.
  constexpr double singular = 1e-12;
  joint[0] = rotation_between(vx, vy, to.z.x, to.z.y, singular * singular, free);
  joint[0] = {choose(free, preferred.c, joint[0].c), choose(free, preferred.s, joint[0].s)};
  status.free[3] = status.free[3] | (free & status.found);

  LanePose reached = rotated_z(LanePose::identity(), joint[0]);
  reached = rotated_z(rotated_x(reached, ca, sa), joint[1]);
  reached = rotated_x(reached, cc, sc);
  // Joint c follows from the whole rotation. It is exact also if axes a and c are nearly parallel.
  const Lanes c = dot(reached.x, to.x) + dot(reached.y, to.y);
  const Lanes s = dot(reached.y, to.x) - dot(reached.x, to.y);
  joint[2] = normalised(c * Lanes(0.5), s * Lanes(0.5));
  reached = rotated_z(reached, joint[2]);
  status.residual = norm1(reached.x - to.x) + norm1(reached.z - to.z) + norm1(to.origin);
}

/// Solves joints a, b, c of parallel axes, a planar 3R arm, from the motion `to` = J_a K_b J_b K_c
/// J_c.
HWY_INLINE void solve_parallel(const PieperLoop& loop, const LanePose& to, Lanes sign,
                               const CosSine& preferred, CosSine* joint, LaneStatus& status) {
  const double* ab = loop.before[4].translation;
  const double* bc = loop.before[5].translation;
  const Lanes x = to.origin.x, y = to.origin.y;
  const Lanes cosine_law =
      Lanes(0.5) *
      (fma(x, x, y * y) - Lanes(ab[0] * ab[0] + ab[1] * ab[1] + bc[0] * bc[0] + bc[1] * bc[1]));
  LaneMask free;
  const LaneMask reached = solve_rotation(
      Lanes(ab[0] * bc[0] + ab[1] * bc[1]), Lanes(ab[1] * bc[0] - ab[0] * bc[1]), -cosine_law, sign,
      loop.size * loop.size, preferred, joint[1], free, status.twin);
  status.found = status.found & (reached | status.continuum());
  status.free[3] = free & status.found;
  const Lanes reach_x = Lanes(ab[0]) + fma(joint[1].c, Lanes(bc[0]), -(joint[1].s * Lanes(bc[1])));
  const Lanes reach_y = Lanes(ab[1]) + fma(joint[1].s, Lanes(bc[0]), joint[1].c * Lanes(bc[1]));
  joint[0] = rotation_between(reach_x, reach_y, x, y, 1e-14 * loop.size * loop.size, free);
  joint[0] = {choose(free, preferred.c, joint[0].c), choose(free, preferred.s, joint[0].s)};
  status.free[3] = status.free[3] | (free & status.found);
  joint[2] = difference(difference({to.x.x, to.x.y}, joint[0]), joint[1]);
  joint[2] = normalised(joint[2].c, joint[2].s);
  status.residual = abs(x - fma(joint[0].c, reach_x, -(joint[0].s * reach_y))) +
                    abs(y - fma(joint[0].s, reach_x, joint[0].c * reach_y)) +
                    abs(to.origin.z - Lanes(loop.height)) + abs(to.z.x) + abs(to.z.y);
}

/// Solves joint e, which maps K_f J_f p to K_e^-1 J_d^-1 x.
HWY_INLINE void solve_middle(const PieperLoop& loop, const RigidMotion* k,
                             const PieperEquations& equations, const CosSine& preferred,
                             CosSine* joint, LaneStatus& status) {
  const bool points = loop.family == PieperLoop::Family::intersecting;
  const Vector from =
      times(k[2], joint_times(equations.p, joint[2], loop.prismatic[2], points), points);
  const Vector to = inverse_times(
      k[1], joint_inverse_times(equations.x, joint[0], loop.prismatic[0], points), points);
  // Distances from axis e relative to the size. Below the first one the distance vanishes. Below
  // the second one it determines the angle to no better than about 1e-6 rad, as at the workspace
  // boundary of an arm whose wrist lies on the axis.
  LaneMask free;
  const double zero = points ? 1e-12 * loop.size : 1e-12;
  const double small = points ? 1e-5 * loop.size : 1e-5;
  joint[1] =
      rotation_between(from.x, from.y, to.x, to.y, zero * zero, free, small * small, &status.weak);
  joint[1] = {choose(free, preferred.c, joint[1].c), choose(free, preferred.s, joint[1].s)};
  status.free[1] = free & status.found;
}

/// Solves all joints. `preferred` has the values of free joints.
HWY_INLINE void solve_joints(const PieperLoop& loop, const RigidMotion* k,
                             const PieperEquations& equations, const CosSine* preferred,
                             CosSine* joint, LaneStatus& status) {
  status.twin = status.far = status.lost = Lanes(1) < Lanes(0);
  for (LaneMask& mask : status.free) mask = status.twin;
  solve_pieper_equations(loop, equations, preferred, joint[2], joint[0], status);
  solve_middle(loop, k, equations, preferred[1], joint, status);
  LanePose whole = after(space(k[0]), joint[0], loop.prismatic[0]);
  whole = after(times(whole, k[1]), joint[1], false);
  whole = after(times(whole, k[2]), joint[2], loop.prismatic[2]);
  const LanePose to = inverse(times(whole, k[3]));
  const Lanes sign = Lanes::load(third_sign);
  if (loop.family == PieperLoop::Family::intersecting) {
    solve_intersecting(loop, to, sign, preferred[3], joint + 3, status);
  } else {
    solve_parallel(loop, to, sign, preferred[3], joint + 3, status);
  }
}

/// Converts joint angles to coordinates: adds the multiple of 2 pi that is nearest to the seed
/// within limits. If none is within the limits, adds the one that violates them least.
HWY_INLINE void to_coordinates(const PieperLoop& loop, const PieperRequest& request,
                               const CosSine* joint, PieperBranches& branches) {
  Lanes distance(0), excess(0);
  for (int i = 0; i < 6; ++i) {
    const int k = loop.order[i];
    const bool prismatic = i < 3 && loop.prismatic[i];
    const Lanes value = prismatic ? joint[i].c : arc_tangent(joint[i].s, joint[i].c);
    Lanes q = (value - Lanes(loop.offset[i])) * Lanes(loop.sign[i]);
    const Lanes seed(request.seed[k]), lower(request.lower[k]), upper(request.upper[k]);
    // A value outside a limit by this much, the rounding of the angles, is set to the limit.
    constexpr double rounding = 1e-11;
    if (request.wraps[k]) {
      const Lanes highest = floor((upper + Lanes(rounding) - q) * Lanes(1 / internal::revolution));
      const Lanes lowest = ceil((lower - Lanes(rounding) - q) * Lanes(1 / internal::revolution));
      // If no multiple is within limits, `lowest` is `highest` + 1, and is used.
      const Lanes revolutions =
          max(min(round((seed - q) * Lanes(1 / internal::revolution)), highest), lowest);
      q = fma(revolutions, Lanes(internal::revolution), q);
      const Lanes below = q - Lanes(internal::revolution);
      q = choose((q > upper + Lanes(rounding)) & (lower - below < q - upper), below, q);
    }
    const Lanes on_limit = min(max(q, lower), upper);
    const LaneMask inside = abs(on_limit - q) <= Lanes(rounding);
    q = choose(inside, on_limit, q);
    excess = excess + abs(on_limit - q);
    distance = fma(Lanes(request.weight[k]) * (q - seed), q - seed, distance);
    q.store(branches.q[k]);
  }
  distance.store(branches.distance);
  excess.store(branches.excess);
  branches.within = branches.found & bits(excess == Lanes(0));
}

void pieper_branches_kernel(const PieperLoop& loop, const PieperRequest& request,
                            PieperBranches& branches) {
  RigidMotion k[4];
  for (int i = 0; i < 4; ++i) {
    if (i != loop.goal_index) k[i] = loop.before[i];
  }
  k[loop.goal_index] = closing_motion(loop, request.world_T_tool);
  const PieperEquations equations = pieper_equations(loop, k);

  CosSine preferred[6];
  for (CosSine& each : preferred) each = {Lanes(1), Lanes(0)};
  const auto prefer_seed = [&] HWY_ATTR {
    for (int i = 0; i < 6; ++i) {
      const double angle = loop.sign[i] * request.seed[loop.order[i]] + loop.offset[i];
      preferred[i] = {Lanes(std::cos(angle)), Lanes(std::sin(angle))};
    }
  };
  CosSine joint[6];
  LaneStatus status;
  // Free joints take the seed's values in a second pass, which is rare and costs six sines.
  for (int pass = 0; pass < 2; ++pass) {
    solve_joints(loop, k, equations, preferred, joint, status);
    if (HWY_LIKELY(pass == 1 || bits(status.continuum()) == 0)) break;
    prefer_seed();
  }
  branches.found = bits(status.found);
  branches.continuum = bits(status.continuum() & status.found);
  for (int i = 0; i < 4; ++i) branches.free[i] = bits(status.free[i] & status.found);
  branches.weak = bits(((status.weak & !status.found) | status.lost) & !status.far);
  branches.twin = bits(status.twin & status.found);
  status.residual.store(branches.residual);
  to_coordinates(loop, request, joint, branches);
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(pieper_branches_kernel);

namespace internal {

void pieper_branches(const PieperLoop& loop, const PieperRequest& request,
                     PieperBranches& branches) {
  HWY_DYNAMIC_DISPATCH(pieper_branches_kernel)(loop, request, branches);
}

}  // namespace internal
}  // namespace beeline
#endif
