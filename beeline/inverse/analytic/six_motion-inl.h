// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_INVERSE_SIX_MOTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_INVERSE_SIX_MOTION_INL_H
#undef BEELINE_INVERSE_SIX_MOTION_INL_H
#else
#define BEELINE_INVERSE_SIX_MOTION_INL_H
#endif

#include <beeline/inverse/analytic/six_loop.h>

#include <beeline/simd/geometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

HWY_INLINE void multiply(const Rigid& a, const Rigid& b, Rigid& product) {
  for (int i = 0; i < 3; ++i) {
    const double* row = a.rotation[i];
    for (int j = 0; j < 3; ++j) {
      product.rotation[i][j] =
          row[0] * b.rotation[0][j] + row[1] * b.rotation[1][j] + row[2] * b.rotation[2][j];
    }
    product.translation[i] = a.translation[i] + row[0] * b.translation[0] +
                             row[1] * b.translation[1] + row[2] * b.translation[2];
  }
}

HWY_INLINE LanePose space(const Rigid& k) {
  const auto& r = k.rotation;
  const double* t = k.translation;
  return {{Lanes(r[0][0]), Lanes(r[1][0]), Lanes(r[2][0])},
          {Lanes(r[0][1]), Lanes(r[1][1]), Lanes(r[2][1])},
          {Lanes(r[0][2]), Lanes(r[1][2]), Lanes(r[2][2])},
          {Lanes(t[0]), Lanes(t[1]), Lanes(t[2])}};
}

HWY_INLINE Vector combined(const LanePose& a, double x, double y, double z) {
  return fma(Lanes(x), a.x, fma(Lanes(y), a.y, Lanes(z) * a.z));
}

HWY_INLINE LanePose times(const LanePose& a, const Rigid& k) {
  const auto& r = k.rotation;
  const double* t = k.translation;
  return {combined(a, r[0][0], r[1][0], r[2][0]), combined(a, r[0][1], r[1][1], r[2][1]),
          combined(a, r[0][2], r[1][2], r[2][2]), combined(a, t[0], t[1], t[2]) + a.origin};
}

/// The frame a after a joint's motion along or about its z axis.
HWY_INLINE LanePose after(const LanePose& a, const CosSine& joint, bool slides) {
  return slides ? translated_z(a, joint.c) : rotated_z(a, joint);
}

/// A point (or a direction) v that a joint carries, and v seen from behind a joint.
HWY_INLINE Vector after_joint(const double* v, const CosSine& joint, bool slides, bool point) {
  if (slides) return {Lanes(v[0]), Lanes(v[1]), point ? Lanes(v[2]) + joint.c : Lanes(v[2])};
  return {fma(joint.c, Lanes(v[0]), -(joint.s * Lanes(v[1]))),
          fma(joint.s, Lanes(v[0]), joint.c * Lanes(v[1])), Lanes(v[2])};
}
HWY_INLINE Vector before_joint(const double* v, const CosSine& joint, bool slides, bool point) {
  return after_joint(v, slides ? CosSine{-joint.c, joint.s} : CosSine{joint.c, -joint.s}, slides,
                     point);
}

/// A point (or a direction) by the motion k, and by its inverse.
HWY_INLINE Vector moved(const Rigid& k, const Vector& v, bool point) {
  const LanePose a = space(k);
  const Vector turned = fma(v.x, a.x, fma(v.y, a.y, v.z * a.z));
  return point ? turned + a.origin : turned;
}
HWY_INLINE Vector moved_back(const Rigid& k, const Vector& v, bool point) {
  const LanePose a = space(k);
  const Vector way = point ? v - a.origin : v;
  return {dot(a.x, way), dot(a.y, way), dot(a.z, way)};
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
