// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_WIDE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_WIDE_INL_H
#undef BEELINE_BATCH_WIDE_INL_H
#else
#define BEELINE_BATCH_WIDE_INL_H
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One register of the machine, a number of another configuration in each place. (Lanes are always
/// eight, which may be four registers: here a dozen numbers stay in registers at a time.)
template <class Real>
struct Wide {
  using Tag = hn::CappedTag<Real, 64 / sizeof(Real)>;
  static constexpr int width = static_cast<int>(hn::MaxLanes(Tag()));
  hn::Vec<Tag> v;

  Wide() = default;
  HWY_INLINE Wide(hn::Vec<Tag> vector) : v(vector) {}
  HWY_INLINE Wide(Real same) : v(hn::Set(Tag(), same)) {}
  static HWY_INLINE Wide load(const Real* row) { return hn::Load(Tag(), row); }
  HWY_INLINE void store(Real* row) const { hn::Store(v, Tag(), row); }

  friend HWY_INLINE Wide operator+(Wide a, Wide b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE Wide operator-(Wide a, Wide b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE Wide operator*(Wide a, Wide b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE Wide operator/(Wide a, Wide b) { return hn::Div(a.v, b.v); }
  friend HWY_INLINE Wide operator-(Wide a) { return hn::Neg(a.v); }
  /// a * b + c
  friend HWY_INLINE Wide fma(Wide a, Wide b, Wide c) { return hn::MulAdd(a.v, b.v, c.v); }
  /// c - a * b
  friend HWY_INLINE Wide fnma(Wide a, Wide b, Wide c) { return hn::NegMulAdd(a.v, b.v, c.v); }
  /// -a * b - c
  friend HWY_INLINE Wide fnms(Wide a, Wide b, Wide c) { return hn::NegMulSub(a.v, b.v, c.v); }
  friend HWY_INLINE Wide sqrt(Wide a) { return hn::Sqrt(a.v); }
  friend HWY_INLINE Wide max(Wide a, Wide b) { return hn::Max(a.v, b.v); }
  friend HWY_INLINE Wide round(Wide a) { return hn::Round(a.v); }
  /// a where b > c, else otherwise.
  friend HWY_INLINE Wide where_greater(Wide b, Wide c, Wide a, Wide otherwise) {
    return hn::IfThenElse(hn::Gt(b.v, c.v), a.v, otherwise.v);
  }
  /// Whether all are at most that (and numbers).
  friend HWY_INLINE bool all_at_most(Wide a, Wide most) {
    return hn::AllTrue(Tag(), hn::Le(a.v, most.v));
  }
};

template <class Real>
struct Triple {
  Wide<Real> x, y, z;

  static HWY_INLINE Triple same(const Real* three) { return {three[0], three[1], three[2]}; }
  static HWY_INLINE Triple load(const Real* rows) {
    constexpr int width = Wide<Real>::width;
    return {Wide<Real>::load(rows), Wide<Real>::load(rows + width),
            Wide<Real>::load(rows + 2 * width)};
  }
  HWY_INLINE void store(Real* rows) const {
    constexpr int width = Wide<Real>::width;
    x.store(rows);
    y.store(rows + width);
    z.store(rows + 2 * width);
  }
  friend HWY_INLINE Triple operator+(const Triple& a, const Triple& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE Triple operator-(const Triple& a, const Triple& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend HWY_INLINE Triple operator-(const Triple& a) { return {-a.x, -a.y, -a.z}; }
  friend HWY_INLINE Triple operator*(Wide<Real> s, const Triple& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  friend HWY_INLINE Triple fma(Wide<Real> s, const Triple& a, const Triple& b) {
    return {fma(s, a.x, b.x), fma(s, a.y, b.y), fma(s, a.z, b.z)};
  }
  friend HWY_INLINE Triple fnma(Wide<Real> s, const Triple& a, const Triple& b) {
    return {fnma(s, a.x, b.x), fnma(s, a.y, b.y), fnma(s, a.z, b.z)};
  }
  friend HWY_INLINE Triple fnms(Wide<Real> s, const Triple& a, const Triple& b) {
    return {fnms(s, a.x, b.x), fnms(s, a.y, b.y), fnms(s, a.z, b.z)};
  }
  friend HWY_INLINE Wide<Real> dot(const Triple& a, const Triple& b) {
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
  }
  friend HWY_INLINE Triple cross(const Triple& a, const Triple& b) {
    return {fnma(a.z, b.y, a.y * b.z), fnma(a.x, b.z, a.z * b.x), fnma(a.y, b.x, a.x * b.y)};
  }
};

/// A frame in the world: its axes and its origin.
template <class Real>
struct WideFrame {
  Triple<Real> x, y, z, origin;

  /// From three numbers of each.
  static HWY_INLINE WideFrame same(const Real* twelve) {
    return {Triple<Real>::same(twelve), Triple<Real>::same(twelve + 3),
            Triple<Real>::same(twelve + 6), Triple<Real>::same(twelve + 9)};
  }
  HWY_INLINE void turn_z(Wide<Real> c, Wide<Real> s) {
    const Triple<Real> before = x;
    x = fma(s, y, c * x);
    y = fnma(s, before, c * y);
  }
  /// By -90 degrees about x, then by this angle about z.
  HWY_INLINE void bend_and_turn_z(Wide<Real> c, Wide<Real> s) {
    const Triple<Real> before = x, along = z;
    z = y;
    x = fnma(s, along, c * before);
    y = fnms(s, before, c * along);
  }
};

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
