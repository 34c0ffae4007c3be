// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_SIMD_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_SIMD_LANES_INL_H
#undef BEELINE_SIMD_LANES_INL_H
#else
#define BEELINE_SIMD_LANES_INL_H
#endif

#include <beeline/simd/fallback-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The number of lanes, the same on every machine: the branches of a six-axis arm. They are one
/// register of AVX-512, two of AVX2, four of SSE4 or NEON.
inline constexpr int lane_count = 8;

using RegisterTag = hn::CappedTag<double, lane_count>;
inline constexpr int register_count = lane_count / static_cast<int>(hn::MaxLanes(RegisterTag()));

/// The result of a comparison, for each lane.
struct LaneMask {
  hn::Mask<RegisterTag> part[register_count];
};

/// Eight numbers. Every operation acts lane by lane.
struct Lanes {
  static constexpr int width = lane_count;
  hn::Vec<RegisterTag> part[register_count];

  Lanes() = default;
  HWY_INLINE Lanes(double same) {
    for (auto& p : part) p = hn::Set(RegisterTag(), same);
  }
  static HWY_INLINE Lanes load(const double* eight) {
    Lanes r;
    for (int i = 0; i < register_count; ++i) {
      r.part[i] = hn::LoadU(RegisterTag(), eight + i * (lane_count / register_count));
    }
    return r;
  }
  /// Loads the first `count` of eight; zero in the other lanes.
  static HWY_INLINE Lanes load_first(const double* first, int count) {
#if HWY_TARGET <= HWY_AVX2  // the others read the masked lanes too
    constexpr int width = lane_count / register_count;
    Lanes r;
    for (int i = 0; i < register_count; ++i) {
      const int left = count - i * width;
      const auto mask = hn::FirstN(RegisterTag(), static_cast<size_t>(left > 0 ? left : 0));
      r.part[i] = hn::MaskedLoad(mask, RegisterTag(), first + i * width);
    }
    return r;
#else
    double eight[lane_count] = {};
    for (int k = 0; k < count; ++k) eight[k] = first[k];
    return load(eight);
#endif
  }
  HWY_INLINE void store(double* eight) const {
    for (int i = 0; i < register_count; ++i) {
      hn::StoreU(part[i], RegisterTag(), eight + i * (lane_count / register_count));
    }
  }
};

// Each line defines an operation on all registers.
#define BEELINE_LANES(RESULT, SIGNATURE, EXPRESSION)                     \
  HWY_INLINE RESULT SIGNATURE {                                          \
    RESULT r;                                                            \
    for (int i = 0; i < register_count; ++i) r.part[i] = hn::EXPRESSION; \
    return r;                                                            \
  }
BEELINE_LANES(Lanes, operator+(Lanes a, Lanes b), Add(a.part[i], b.part[i]))
BEELINE_LANES(Lanes, operator-(Lanes a, Lanes b), Sub(a.part[i], b.part[i]))
BEELINE_LANES(Lanes, operator*(Lanes a, Lanes b), Mul(a.part[i], b.part[i]))
BEELINE_LANES(Lanes, operator/(Lanes a, Lanes b), Div(a.part[i], b.part[i]))
BEELINE_LANES(Lanes, operator-(Lanes a), Neg(a.part[i]))
BEELINE_LANES(Lanes, fma(Lanes a, Lanes b, Lanes c), MulAdd(a.part[i], b.part[i], c.part[i]))
BEELINE_LANES(Lanes, sqrt(Lanes a), Sqrt(a.part[i]))
BEELINE_LANES(Lanes, abs(Lanes a), Abs(a.part[i]))
BEELINE_LANES(Lanes, round(Lanes a), Round(a.part[i]))
BEELINE_LANES(Lanes, floor(Lanes a), Floor(a.part[i]))
BEELINE_LANES(Lanes, ceil(Lanes a), Ceil(a.part[i]))
BEELINE_LANES(Lanes, min(Lanes a, Lanes b), Min(a.part[i], b.part[i]))
BEELINE_LANES(Lanes, max(Lanes a, Lanes b), Max(a.part[i], b.part[i]))
BEELINE_LANES(Lanes, with_sign(Lanes size, Lanes sign), CopySign(size.part[i], sign.part[i]))
BEELINE_LANES(LaneMask, operator<(Lanes a, Lanes b), Lt(a.part[i], b.part[i]))
BEELINE_LANES(LaneMask, operator<=(Lanes a, Lanes b), Le(a.part[i], b.part[i]))
BEELINE_LANES(LaneMask, operator==(Lanes a, Lanes b), Eq(a.part[i], b.part[i]))
BEELINE_LANES(LaneMask, operator&(LaneMask a, LaneMask b), And(a.part[i], b.part[i]))
BEELINE_LANES(LaneMask, operator|(LaneMask a, LaneMask b), Or(a.part[i], b.part[i]))
BEELINE_LANES(LaneMask, operator!(LaneMask a), Not(a.part[i]))
BEELINE_LANES(Lanes, choose(LaneMask which, Lanes yes, Lanes no),
              IfThenElse(which.part[i], yes.part[i], no.part[i]))
#undef BEELINE_LANES

HWY_INLINE LaneMask operator>(Lanes a, Lanes b) { return b < a; }
HWY_INLINE LaneMask operator>=(Lanes a, Lanes b) { return b <= a; }
HWY_INLINE Lanes& operator+=(Lanes& a, Lanes b) { return a = a + b; }
HWY_INLINE Lanes& operator-=(Lanes& a, Lanes b) { return a = a - b; }
HWY_INLINE Lanes& operator*=(Lanes& a, Lanes b) { return a = a * b; }

/// c - a * b; rounded once where the machine has fused multiply-add.
HWY_INLINE Lanes fnma(Lanes a, Lanes b, Lanes c) {
  Lanes r;
  for (int i = 0; i < register_count; ++i) {
    r.part[i] = hn::NegMulAdd(a.part[i], b.part[i], c.part[i]);
  }
  return r;
}

/// The smallest and the largest of the eight numbers, none of which may be NaN.
HWY_INLINE double smallest_of(Lanes a) {
  auto least = a.part[0];
  for (int i = 1; i < register_count; ++i) least = hn::Min(least, a.part[i]);
  return hn::GetLane(hn::MinOfLanes(RegisterTag(), least));
}
HWY_INLINE double largest_of(Lanes a) {
  auto most = a.part[0];
  for (int i = 1; i < register_count; ++i) most = hn::Max(most, a.part[i]);
  return hn::GetLane(hn::MaxOfLanes(RegisterTag(), most));
}

/// Bit k is set where the mask holds in lane k.
HWY_INLINE unsigned bits(LaneMask mask) {
  constexpr int width = lane_count / register_count;
  unsigned r = 0;
  for (int i = 0; i < register_count; ++i) {
    uint8_t bytes[8] = {};
    hn::StoreMaskBits(RegisterTag(), mask.part[i], bytes);
    r |= static_cast<unsigned>(bytes[0]) << (i * width);
  }
  return r;
}

HWY_INLINE LaneMask mask_of(unsigned bits) {
  double chosen[lane_count];
  for (int k = 0; k < lane_count; ++k) chosen[k] = (bits >> k) & 1 ? 1 : 0;
  return Lanes::load(chosen) > Lanes(0);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
