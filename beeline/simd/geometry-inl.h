// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_SIMD_GEOMETRY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_SIMD_GEOMETRY_INL_H
#undef BEELINE_SIMD_GEOMETRY_INL_H
#else
#define BEELINE_SIMD_GEOMETRY_INL_H
#endif

#include <beeline/simd/trigonometry-inl.h>
#include <beeline/simd/vector-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// The cosine and sine of an angle. For a prismatic joint c is its displacement, and s the square
/// of that or unused.
struct CosSine {
  Lanes c, s;
};

/// Scales c and s, whose squares sum to nearly 1, to the unit circle: one Newton step for 1/sqrt at
/// 1, which squares the relative error.
HWY_INLINE CosSine normalised(Lanes c, Lanes s) {
  const Lanes scale = fnma(Lanes(0.5), fma(c, c, s * s), Lanes(1.5));
  return {c * scale, s * scale};
}

/// The cosine and sine of the difference a - b of two angles.
HWY_INLINE CosSine difference(const CosSine& a, const CosSine& b) {
  return {fma(a.c, b.c, a.s * b.s), fma(a.s, b.c, -(a.c * b.s))};
}

/// Eight vectors.
using Vector = VectorOf<Lanes>;

HWY_INLINE Lanes norm1(const Vector& a) { return abs(a.x) + abs(a.y) + abs(a.z); }

/// Eight poses: the axes and the origin of one frame in another.
struct LanePose {
  Vector x, y, z, origin;

  static HWY_INLINE LanePose identity() {
    const Lanes zero(0), one(1);
    return {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}, {zero, zero, zero}};
  }
};

HWY_INLINE LanePose inverse(const LanePose& a) {
  return {{a.x.x, a.y.x, a.z.x},
          {a.x.y, a.y.y, a.z.y},
          {a.x.z, a.y.z, a.z.z},
          {-dot(a.x, a.origin), -dot(a.y, a.origin), -dot(a.z, a.origin)}};
}

/// The products a Rot_z, a Rot_x and a Trans_z.
HWY_INLINE LanePose rotated_z(const LanePose& a, const CosSine& t) {
  return {fma(t.c, a.x, t.s * a.y), fma(t.c, a.y, (-t.s) * a.x), a.z, a.origin};
}
HWY_INLINE LanePose rotated_x(const LanePose& a, Lanes c, Lanes s) {
  return {a.x, fma(c, a.y, s * a.z), fma(c, a.z, (-s) * a.y), a.origin};
}
HWY_INLINE LanePose translated_z(const LanePose& a, Lanes d) {
  return {a.x, a.y, a.z, fma(d, a.z, a.origin)};
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
