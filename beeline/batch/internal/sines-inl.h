// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_INTERNAL_SINES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_INTERNAL_SINES_INL_H
#undef BEELINE_BATCH_INTERNAL_SINES_INL_H
#else
#define BEELINE_BATCH_INTERNAL_SINES_INL_H
#endif

#include <cmath>
#include <iterator>

#include <beeline/batch/internal/plan.h>

#include <beeline/batch/internal/packet-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

using internal::BatchPlan;

/// Coefficients of (sin x / x - 1) / x^2 and (cos x - 1 + x^2 / 2) / x^4 as polynomials of x^2,
/// interpolated at the Chebyshev points of |x| <= pi/2, with errors of 1.3e-18 and 6.4e-17 (float:
/// 2.7e-8 and 3.6e-9). `pi` is pi as a sum of words whose products with k are exact, or part of a
/// fused operation that rounds once; `largest_angle` bounds the angles for which that holds.
template <class Real>
struct SineCoefficients;

#undef BEELINE_BATCH_FUSED
#if HWY_NATIVE_FMA
#define BEELINE_BATCH_FUSED 1  // k pi[0] is not rounded: two words are enough
#else
#define BEELINE_BATCH_FUSED 0
#endif

template <>
struct SineCoefficients<double> {
  static constexpr double sine[] = {-0.16666666666666666,    0.008333333333333316,
                                    -0.00019841269841254795, 2.7557319219115013e-06,
                                    -2.505210761086116e-08,  1.6058976915095007e-10,
                                    -7.643957622560617e-13,  2.7312868913092307e-15};
  static constexpr double cosine[] = {0.04166666666666666,    -0.0013888888888884717,
                                      2.4801587298886815e-05, -2.755731856817136e-07,
                                      2.0876681108263528e-09, -1.1466234424282487e-11,
                                      4.646173408703228e-14};
#if BEELINE_BATCH_FUSED
  static constexpr double pi[] = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53, 0};
#else
  static constexpr double pi[] = {0x1.921fb544p+1, 0x1.0b4611a6p-33, 0x1.3198a2e037073p-68};
#endif
  static constexpr double largest_angle = 1e6 + 1;
};

template <>
struct SineCoefficients<float> {
  static constexpr float sine[] = {-0.16666665958223517f, 0.008333241592248764f,
                                   -0.0001982266631335637f, 2.6345195628507823e-06f};
  static constexpr float cosine[] = {0.041666666073615126f, -0.0013888812096170288f,
                                     2.4786021085607286e-05f, -2.6544079868169615e-07f};
#if BEELINE_BATCH_FUSED
  static constexpr float pi[] = {0x1.921fb6p+1f, -0x1.777a5cp-24f, 0};
#else
  static constexpr float pi[] = {3.140625f, 9.67502593994140625e-4f, 1.509957990978376432e-7f};
#endif
  static constexpr float largest_angle = 4096;
};

/// Reduces the link's angle theta = `value` + theta_offset by multiples of pi to [-pi/2, pi/2], to
/// rounding. The multiple is subtracted from `value` before the offset is added, so that the offset
/// keeps its digits. Sets `sign` to the sign bit where the multiple is odd.
template <class Real>
HWY_INLINE Packet<Real> reduced_angle(Packet<Real> value,
                                      const typename BatchPlan<Real>::Link& link,
                                      Packet<Real>& sign) {
  using Coefficients = SineCoefficients<Real>;
  using W = Packet<Real>;
  constexpr Real by_pi = static_cast<Real>(0.318309886183790671538);  // 1 / pi
  const W whole = link.half_turns;
  W rounded;
  if (link.has_remainder) {
    rounded = fma(value, W(by_pi), W(link.remainder_by_pi)) + whole;
  } else {
    rounded = fma(value, W(by_pi), whole);
  }
  const W k = rounded - whole;
  W r = fnma(k, W(Coefficients::pi[0]), value);
  if (link.has_remainder) r = r + W(link.remainder);
  r = fnma(k, W(Coefficients::pi[1]), r);
  if (!BEELINE_BATCH_FUSED) r = fnma(k, W(Coefficients::pi[2]), r);
  // The last bit of the rounded number is the parity of k.
  const typename W::Tag d;
  const hn::RebindToSigned<decltype(d)> whole_tag;
  sign = hn::BitCast(d, hn::ShiftLeft<8 * sizeof(Real) - 1>(hn::BitCast(whole_tag, rounded.v)));
  return r;
}

/// Stores the sine and the cosine of a reduced angle with its sign. The error is about 1.5 units in
/// the last place of 1.
template <class Real>
HWY_INLINE void store_sine_cosine(Packet<Real> r, Packet<Real> sign, Real* sine, Real* cosine) {
  using Coefficients = SineCoefficients<Real>;
  using W = Packet<Real>;
  constexpr int terms = std::size(Coefficients::sine), even_terms = std::size(Coefficients::cosine);
  const W z = r * r;
  W s = Coefficients::sine[terms - 1], c = Coefficients::cosine[even_terms - 1];
  for (int k = terms - 2; k >= 0; --k) {
    s = fma(z, s, W(Coefficients::sine[k]));
    if (k < even_terms - 1) c = fma(z, c, W(Coefficients::cosine[k]));
  }
  s = fma(z * r, s, r);
  c = fma(z * z, c, fnma(z, W(Real(0.5)), W(Real(1))));
  W(hn::Xor(s.v, sign.v)).store(sine);
  W(hn::Xor(c.v, sign.v)).store(cosine);
}

/// Replaces the values beyond largest_angle, lane by lane, by the C library's values. They are NaN
/// if the coordinate is not finite.
template <class Real>
HWY_NOINLINE void replace_far_sines(const Real* coordinate,
                                    const typename BatchPlan<Real>::Link& link, Real* sine,
                                    Real* cosine) {
  for (int lane = 0; lane < Packet<Real>::width; ++lane) {
    const Real value = link.theta_per_q * coordinate[lane];
    if (std::abs(value) <= SineCoefficients<Real>::largest_angle) continue;
    const double s = std::sin(static_cast<double>(value)), s0 = link.sin_offset;
    const double c = std::cos(static_cast<double>(value)), c0 = link.cos_offset;
    sine[lane] = static_cast<Real>(s * c0 + c * s0);
    cosine[lane] = static_cast<Real>(c * c0 - s * s0);
  }
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
