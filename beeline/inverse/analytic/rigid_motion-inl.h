// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_INVERSE_RIGID_MOTION_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_INVERSE_RIGID_MOTION_INL_H
#undef BEELINE_INVERSE_RIGID_MOTION_INL_H
#else
#define BEELINE_INVERSE_RIGID_MOTION_INL_H
#endif

#include <beeline/inverse/analytic/rigid_motion.h>

#include <beeline/simd/geometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

using internal::RigidMotion;

HWY_INLINE double dot(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Computes product = a b.
HWY_INLINE void multiply(const RigidMotion& a, const RigidMotion& b, RigidMotion& product) {
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

/// Returns the same motion in every lane.
HWY_INLINE LanePose space(const RigidMotion& k) {
  const auto& r = k.rotation;
  const double* t = k.translation;
  return {{Lanes(r[0][0]), Lanes(r[1][0]), Lanes(r[2][0])},
          {Lanes(r[0][1]), Lanes(r[1][1]), Lanes(r[2][1])},
          {Lanes(r[0][2]), Lanes(r[1][2]), Lanes(r[2][2])},
          {Lanes(t[0]), Lanes(t[1]), Lanes(t[2])}};
}

/// Returns x a.x + y a.y + z a.z: the vector (x, y, z) of the frame a.
HWY_INLINE Vector combined(const LanePose& a, double x, double y, double z) {
  return fma(Lanes(x), a.x, fma(Lanes(y), a.y, Lanes(z) * a.z));
}

/// Returns the product a k.
HWY_INLINE LanePose times(const LanePose& a, const RigidMotion& k) {
  const auto& r = k.rotation;
  const double* t = k.translation;
  return {combined(a, r[0][0], r[1][0], r[2][0]), combined(a, r[0][1], r[1][1], r[2][1]),
          combined(a, r[0][2], r[1][2], r[2][2]), combined(a, t[0], t[1], t[2]) + a.origin};
}

/// Returns the frame a after a joint's motion about its z axis (revolute) or along it (prismatic).
HWY_INLINE LanePose after(const LanePose& a, const CosSine& joint, bool prismatic) {
  return prismatic ? translated_z(a, joint.c) : rotated_z(a, joint);
}

/// Returns J v for a joint's motion J about or along z. v is a point, or a direction, which a
/// translation leaves unchanged.
HWY_INLINE Vector joint_times(const double* v, const CosSine& joint, bool prismatic, bool point) {
  if (prismatic) return {Lanes(v[0]), Lanes(v[1]), point ? Lanes(v[2]) + joint.c : Lanes(v[2])};
  return {fma(joint.c, Lanes(v[0]), -(joint.s * Lanes(v[1]))),
          fma(joint.s, Lanes(v[0]), joint.c * Lanes(v[1])), Lanes(v[2])};
}

/// Returns J^-1 v.
HWY_INLINE Vector joint_inverse_times(const double* v, const CosSine& joint, bool prismatic,
                                      bool point) {
  const CosSine inverse = prismatic ? CosSine{-joint.c, joint.s} : CosSine{joint.c, -joint.s};
  return joint_times(v, inverse, prismatic, point);
}

/// Returns k v for a point or a direction v.
HWY_INLINE Vector times(const RigidMotion& k, const Vector& v, bool point) {
  const LanePose a = space(k);
  const Vector rotated = fma(v.x, a.x, fma(v.y, a.y, v.z * a.z));
  return point ? rotated + a.origin : rotated;
}

/// Returns k^-1 v.
HWY_INLINE Vector inverse_times(const RigidMotion& k, const Vector& v, bool point) {
  const LanePose a = space(k);
  const Vector offset = point ? v - a.origin : v;
  return {dot(a.x, offset), dot(a.y, offset), dot(a.z, offset)};
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
