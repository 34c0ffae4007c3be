// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_SIMD_VECTOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_SIMD_VECTOR_INL_H
#undef BEELINE_SIMD_VECTOR_INL_H
#else
#define BEELINE_SIMD_VECTOR_INL_H
#endif

#include <beeline/simd/fallback-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// 3-vectors in lanes: each component is a Number with one value for each vector. Number is Lanes
/// (simd/lanes-inl.h) or a Packet (batch/internal/packet-inl.h).
template <class Number>
struct VectorOf {
  Number x, y, z;

  /// From three rows, and to three rows, of Number::width values each.
  template <class Real>
  static HWY_INLINE VectorOf load(const Real* rows) {
    return {Number::load(rows), Number::load(rows + Number::width),
            Number::load(rows + 2 * Number::width)};
  }
  template <class Real>
  HWY_INLINE void store(Real* rows) const {
    x.store(rows);
    y.store(rows + Number::width);
    z.store(rows + 2 * Number::width);
  }

  friend HWY_INLINE VectorOf operator+(const VectorOf& a, const VectorOf& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE VectorOf operator-(const VectorOf& a, const VectorOf& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend HWY_INLINE VectorOf operator*(Number s, const VectorOf& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  /// s a + b
  friend HWY_INLINE VectorOf fma(Number s, const VectorOf& a, const VectorOf& b) {
    return {fma(s, a.x, b.x), fma(s, a.y, b.y), fma(s, a.z, b.z)};
  }
  /// b - s a
  friend HWY_INLINE VectorOf fnma(Number s, const VectorOf& a, const VectorOf& b) {
    return {fnma(s, a.x, b.x), fnma(s, a.y, b.y), fnma(s, a.z, b.z)};
  }
  /// -s a - b
  friend HWY_INLINE VectorOf fnms(Number s, const VectorOf& a, const VectorOf& b) {
    return {fnms(s, a.x, b.x), fnms(s, a.y, b.y), fnms(s, a.z, b.z)};
  }
  friend HWY_INLINE Number dot(const VectorOf& a, const VectorOf& b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
  }
  friend HWY_INLINE VectorOf cross(const VectorOf& a, const VectorOf& b) {
    return {fnma(a.z, b.y, a.y * b.z), fnma(a.x, b.z, a.z * b.x), fnma(a.y, b.x, a.x * b.y)};
  }
};

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
