// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_SIMD_SPACE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_SIMD_SPACE_INL_H
#undef BEELINE_SIMD_SPACE_INL_H
#else
#define BEELINE_SIMD_SPACE_INL_H
#endif

#include <beeline/simd/trigonometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// The cosine and sine of an angle; for a slide `c` is its travel, and `s` that squared or unused.
struct Turn {
  Lanes c, s;
};

/// The turn whose cosine and sine are nearly these: what is wrong with their length shrinks to its
/// square (a step of Newton's for 1/sqrt at 1).
HWY_INLINE Turn made_unit(Lanes c, Lanes s) {
  const Lanes scale = fnma(Lanes(0.5), fma(c, c, s * s), Lanes(1.5));
  return {c * scale, s * scale};
}

/// The turn a without b.
HWY_INLINE Turn less(const Turn& a, const Turn& b) {
  return {fma(a.c, b.c, a.s * b.s), fma(a.s, b.c, -(a.c * b.s))};
}

struct Vector {
  Lanes x, y, z;
};
HWY_INLINE Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Vector operator*(Lanes a, const Vector& b) { return {a * b.x, a * b.y, a * b.z}; }
HWY_INLINE Vector fma(Lanes a, const Vector& b, const Vector& c) {
  return {fma(a, b.x, c.x), fma(a, b.y, c.y), fma(a, b.z, c.z)};
}
HWY_INLINE Lanes dot(const Vector& a, const Vector& b) {
  return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
}
HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
  return {fma(a.y, b.z, -(a.z * b.y)), fma(a.z, b.x, -(a.x * b.z)), fma(a.x, b.y, -(a.y * b.x))};
}
HWY_INLINE Lanes norm1(const Vector& a) { return abs(a.x) + abs(a.y) + abs(a.z); }

/// A pose: the axes and the origin of one frame, in another.
struct Space {
  Vector x, y, z, origin;

  static HWY_INLINE Space identity() {
    const Lanes none(0), one(1);
    return {{one, none, none}, {none, one, none}, {none, none, one}, {none, none, none}};
  }
};

HWY_INLINE Space inverse(const Space& a) {
  return {{a.x.x, a.y.x, a.z.x},
          {a.x.y, a.y.y, a.z.y},
          {a.x.z, a.y.z, a.z.z},
          {-dot(a.x, a.origin), -dot(a.y, a.origin), -dot(a.z, a.origin)}};
}

/// The frame a, turned about its own z or x axis, or moved along its z axis.
HWY_INLINE Space turned_z(const Space& a, const Turn& t) {
  return {fma(t.c, a.x, t.s * a.y), fma(t.c, a.y, (-t.s) * a.x), a.z, a.origin};
}
HWY_INLINE Space turned_x(const Space& a, Lanes c, Lanes s) {
  return {a.x, fma(c, a.y, s * a.z), fma(c, a.z, (-s) * a.y), a.origin};
}
HWY_INLINE Space moved_z(const Space& a, Lanes travel) {
  return {a.x, a.y, a.z, fma(travel, a.z, a.origin)};
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
