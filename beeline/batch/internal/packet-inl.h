// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_INTERNAL_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_INTERNAL_PACKET_INL_H
#undef BEELINE_BATCH_INTERNAL_PACKET_INL_H
#else
#define BEELINE_BATCH_INTERNAL_PACKET_INL_H
#endif

#include <hwy/highway.h>

#include <beeline/simd/vector-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// One register, with one number of a different configuration in each lane. (Lanes always has eight
/// lanes, in up to four registers. Here a dozen numbers stay in registers at once.)
template <class Real>
struct Packet {
  using Tag = hn::CappedTag<Real, 64 / sizeof(Real)>;
  static constexpr int width = static_cast<int>(hn::MaxLanes(Tag()));
  hn::Vec<Tag> v;

  Packet() = default;
  HWY_INLINE Packet(hn::Vec<Tag> vector) : v(vector) {}
  HWY_INLINE Packet(Real same) : v(hn::Set(Tag(), same)) {}
  static HWY_INLINE Packet load(const Real* row) { return hn::Load(Tag(), row); }
  HWY_INLINE void store(Real* row) const { hn::Store(v, Tag(), row); }

  friend HWY_INLINE Packet operator+(Packet a, Packet b) { return hn::Add(a.v, b.v); }
  friend HWY_INLINE Packet operator-(Packet a, Packet b) { return hn::Sub(a.v, b.v); }
  friend HWY_INLINE Packet operator*(Packet a, Packet b) { return hn::Mul(a.v, b.v); }
  friend HWY_INLINE Packet operator/(Packet a, Packet b) { return hn::Div(a.v, b.v); }
  friend HWY_INLINE Packet operator-(Packet a) { return hn::Neg(a.v); }
  /// a * b + c
  friend HWY_INLINE Packet fma(Packet a, Packet b, Packet c) { return hn::MulAdd(a.v, b.v, c.v); }
  /// c - a * b
  friend HWY_INLINE Packet fnma(Packet a, Packet b, Packet c) {
    return hn::NegMulAdd(a.v, b.v, c.v);
  }
  /// -a * b - c
  friend HWY_INLINE Packet fnms(Packet a, Packet b, Packet c) {
    return hn::NegMulSub(a.v, b.v, c.v);
  }
  friend HWY_INLINE Packet sqrt(Packet a) { return hn::Sqrt(a.v); }
  friend HWY_INLINE Packet max(Packet a, Packet b) { return hn::Max(a.v, b.v); }
  friend HWY_INLINE Packet round(Packet a) { return hn::Round(a.v); }
  /// Selects a where b > c, otherwise `otherwise`.
  friend HWY_INLINE Packet where_greater(Packet b, Packet c, Packet a, Packet otherwise) {
    return hn::IfThenElse(hn::Gt(b.v, c.v), a.v, otherwise.v);
  }
  /// Returns whether a <= b in all lanes; false if a is NaN.
  friend HWY_INLINE bool all_at_most(Packet a, Packet b) {
    return hn::AllTrue(Tag(), hn::Le(a.v, b.v));
  }
};

template <class Real>
using PacketVector = VectorOf<Packet<Real>>;

/// The same three numbers in every lane.
template <class Real>
HWY_INLINE PacketVector<Real> broadcast(const Real* three) {
  return {three[0], three[1], three[2]};
}

/// A frame in the world for each lane: its axes and its origin.
template <class Real>
struct PacketFrame {
  PacketVector<Real> x, y, z, origin;

  /// The same frame in every lane.
  static HWY_INLINE PacketFrame broadcast_from(const Real* twelve) {
    return {broadcast(twelve), broadcast(twelve + 3), broadcast(twelve + 6), broadcast(twelve + 9)};
  }
  HWY_INLINE void rotate_z(Packet<Real> c, Packet<Real> s) {
    const PacketVector<Real> before = x;
    x = fma(s, y, c * x);
    y = fnma(s, before, c * y);
  }
  /// Multiplies by Rot_x(-90 deg) and by Rot_z of the angle with this cosine and sine.
  HWY_INLINE void rotate_minus_quarter_x_then_z(Packet<Real> c, Packet<Real> s) {
    const PacketVector<Real> x_before = x, z_before = z;
    z = y;
    x = fnma(s, z_before, c * x_before);
    y = fnms(s, x_before, c * z_before);
  }
};

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
