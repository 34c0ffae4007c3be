// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_BATCH_SINES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_BATCH_SINES_INL_H
#undef BEELINE_BATCH_SINES_INL_H
#else
#define BEELINE_BATCH_SINES_INL_H
#endif

#include <cmath>
#include <iterator>

#include <beeline/batch/plan.h>

#include <beeline/batch/wide-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// Sines, (sin x / x - 1) / x^2, and cosines, (cos x - 1 + x^2 / 2) / x^4, as polynomials of x^2:
/// interpolated at Chebyshev's points of |x| <= pi/2; to 1.3e-18 and 6.4e-17, in float to 2.7e-8
/// and 3.6e-9. Then pi in words: their products with k are exact, or inside an operation that
/// rounds once; `reach` is the largest size of an angle for which they do.
template <class Real>
struct SineNumbers;

#undef BEELINE_BATCH_FUSED
#if HWY_TARGET <= HWY_AVX2
#define BEELINE_BATCH_FUSED 1  // k pi[0] is not rounded, so two words of full length do
#else
#define BEELINE_BATCH_FUSED 0
#endif

template <>
struct SineNumbers<double> {
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
  static constexpr double reach = 1e6 + 1;
};

template <>
struct SineNumbers<float> {
  static constexpr float sine[] = {-0.16666665958223517f, 0.008333241592248764f,
                                   -0.0001982266631335637f, 2.6345195628507823e-06f};
  static constexpr float cosine[] = {0.041666666073615126f, -0.0013888812096170288f,
                                     2.4786021085607286e-05f, -2.6544079868169615e-07f};
#if BEELINE_BATCH_FUSED
  static constexpr float pi[] = {0x1.921fb6p+1f, -0x1.777a5cp-24f, 0};
#else
  static constexpr float pi[] = {3.140625f, 9.67502593994140625e-4f, 1.509957990978376432e-7f};
#endif
  static constexpr float reach = 4096;
};

/// The link's angle, which is `value` and what it is at rest, without whole half turns: in [-pi/2,
/// pi/2], but for rounding. The value's turns are taken off before the rest comes to it, whose
/// digits are so not lost. `sign` gets the sign bit where the half turns are odd.
template <class Real>
HWY_INLINE Wide<Real> without_half_turns(Wide<Real> value,
                                         const typename BatchPlan<Real>::Link& link,
                                         Wide<Real>& sign) {
  using Numbers = SineNumbers<Real>;
  using W = Wide<Real>;
  constexpr Real turns = static_cast<Real>(0.318309886183790671538);  // 1 / pi
  const W whole = link.whole;
  W marked;
  if (link.bent) {
    marked = fma(value, W(turns), W(link.rest_by_pi)) + whole;
  } else {
    marked = fma(value, W(turns), whole);
  }
  const W k = marked - whole;
  W r = fnma(k, W(Numbers::pi[0]), value);
  if (link.bent) r = r + W(link.rest);
  r = fnma(k, W(Numbers::pi[1]), r);
  if (!BEELINE_BATCH_FUSED) r = fnma(k, W(Numbers::pi[2]), r);
  // The last bit of `marked`.
  const typename W::Tag d;
  const hn::RebindToSigned<decltype(d)> whole_tag;
  sign = hn::BitCast(d, hn::ShiftLeft<8 * sizeof(Real) - 1>(hn::BitCast(whole_tag, marked.v)));
  return r;
}

/// Sines and cosines of angles without half turns, whose signs are given, to rows. To about 1.5
/// units in the last place of 1. Each step is done for all, so that none waits for the one before.
template <int count, class Real>
HWY_INLINE void sines_to_rows(const Wide<Real> (&r)[count], const Wide<Real> (&sign)[count],
                              Real* sines, Real* cosines) {
  using Numbers = SineNumbers<Real>;
  using W = Wide<Real>;
  constexpr int width = W::width;
  constexpr int terms = std::size(Numbers::sine), even_terms = std::size(Numbers::cosine);
  W z[count], s[count], c[count];
  for (int i = 0; i < count; ++i) z[i] = r[i] * r[i];
  for (int i = 0; i < count; ++i) s[i] = Numbers::sine[terms - 1];
  for (int i = 0; i < count; ++i) c[i] = Numbers::cosine[even_terms - 1];
  for (int k = terms - 2; k >= 0; --k) {
    for (int i = 0; i < count; ++i) s[i] = fma(z[i], s[i], W(Numbers::sine[k]));
    for (int i = 0; i < count && k < even_terms - 1; ++i) {
      c[i] = fma(z[i], c[i], W(Numbers::cosine[k]));
    }
  }
  for (int i = 0; i < count; ++i) {
    s[i] = fma(z[i] * r[i], s[i], r[i]);
    c[i] = fma(z[i] * z[i], c[i], fnma(z[i], W(Real(0.5)), W(Real(1))));
    W(hn::Xor(s[i].v, sign[i].v)).store(sines + i * width);
    W(hn::Xor(c[i].v, sign[i].v)).store(cosines + i * width);
  }
}

/// Replaces those whose value is beyond reach, one by one by the C library. What is not finite
/// becomes no number.
template <class Real>
HWY_NOINLINE void sine_cosine_far(const Real* coordinate,
                                  const typename BatchPlan<Real>::Link& link, Real* sine,
                                  Real* cosine) {
  for (int lane = 0; lane < Wide<Real>::width; ++lane) {
    const Real value = link.turn * coordinate[lane];
    if (std::abs(value) <= SineNumbers<Real>::reach) continue;
    const double s = std::sin(static_cast<double>(value)), s0 = link.sin_angle;
    const double c = std::cos(static_cast<double>(value)), c0 = link.cos_angle;
    sine[lane] = static_cast<Real>(s * c0 + c * s0);
    cosine[lane] = static_cast<Real>(c * c0 - s * s0);
  }
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
