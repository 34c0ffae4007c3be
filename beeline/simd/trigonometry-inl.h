// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_SIMD_TRIGONOMETRY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_SIMD_TRIGONOMETRY_INL_H
#undef BEELINE_SIMD_TRIGONOMETRY_INL_H
#else
#define BEELINE_SIMD_TRIGONOMETRY_INL_H
#endif

#include <cmath>

#include <beeline/simd/lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

// The coefficients of sine and cosine come from Moshier's Cephes library (sin.c; 1984-2000).

/// Computes sine and cosine of every finite angle, with an error of about 1.5 units in the last
/// place of 1. Beyond 1e6 rad, where three words of pi are too few, it calls the C library.
///
/// batch/internal/sines-inl.h has another version. It is for float too, takes the offset of the
/// joint's angle into the argument reduction, by pi, and interleaves the polynomials of several
/// links; this one has one angle in each lane.
HWY_INLINE void sine_cosine(Lanes angle, Lanes& sine, Lanes& cosine) {
  // x = k pi/2 + r (Cody & Waite, "Software Manual for the Elementary Functions", 1980). Each word
  // of pi/2 has 33 bits, so its product with k is exact.
  const Lanes k = round(angle * Lanes(0x1.45f306dc9c883p-1));
  Lanes r = fnma(k, Lanes(0x1.921fb544p+0), angle);
  r = fnma(k, Lanes(0x1.0b4611a6p-34), r);
  r = fnma(k, Lanes(0x1.3198a2e037073p-69), r);
  const Lanes z = r * r;

  Lanes s = fma(z, Lanes(1.58962301576546568060e-10), Lanes(-2.50507477628578072866e-8));
  s = fma(z, s, Lanes(2.75573136213857245213e-6));
  s = fma(z, s, Lanes(-1.98412698295895385996e-4));
  s = fma(z, s, Lanes(8.33333333332211858878e-3));
  s = fma(z, s, Lanes(-1.66666666666666307295e-1));
  s = fma(z * r, s, r);

  Lanes c = fma(z, Lanes(-1.13585365213876817300e-11), Lanes(2.08757008419747316778e-9));
  c = fma(z, c, Lanes(-2.75573141792967388112e-7));
  c = fma(z, c, Lanes(2.48015872888517045348e-5));
  c = fma(z, c, Lanes(-1.38888888888730564116e-3));
  c = fma(z, c, Lanes(4.16666666666665929218e-2));
  c = fma(z * z, c, fnma(z, Lanes(0.5), Lanes(1)));

  // k modulo 4: odd quarters exchange sine and cosine, and each quarter has its signs.
  const Lanes quarter = fnma(floor(k * Lanes(0.25)), Lanes(4), k);
  const LaneMask swap = (quarter == Lanes(1)) | (quarter == Lanes(3));
  const Lanes a = choose(swap, c, s), b = choose(swap, s, c);
  sine = choose(quarter >= Lanes(2), -a, a);
  cosine = choose((quarter == Lanes(1)) | (quarter == Lanes(2)), -b, b);

  const LaneMask far = abs(angle) > Lanes(1e6);
  if (HWY_UNLIKELY(bits(far) != 0)) {
    double x[lane_count], sines[lane_count], cosines[lane_count];
    angle.store(x);
    for (int lane = 0; lane < lane_count; ++lane) {
      sines[lane] = std::sin(x[lane]);
      cosines[lane] = std::cos(x[lane]);
    }
    sine = choose(far, Lanes::load(sines), sine);
    cosine = choose(far, Lanes::load(cosines), cosine);
  }
}

/// The angle of the point (x, y), in [-pi, pi], to about 2 units in the last place; 0 at (0, 0).
HWY_INLINE Lanes arc_tangent(Lanes y, Lanes x) {
  const Lanes ax = abs(x), ay = abs(y);
  const Lanes low = min(ax, ay), high = max(ax, ay);
  // atan(t) = pi/4 + atan((t - 1) / (t + 1)) keeps the argument below tan(pi/8) in size.
  const LaneMask steep = low > Lanes(0x1.a827999fcef32p-2) * high;
  const Lanes over = choose(steep, low - high, low);
  const Lanes under = choose(steep, low + high, high);
  const Lanes t = over / choose(under == Lanes(0), Lanes(1), under);
  const Lanes z = t * t, zz = z * z;
  // (atan(t) / t - 1) / z, interpolated at Chebyshev points to 3e-17; even and odd powers are
  // summed apart, which shortens the dependency chain.
  Lanes even = fma(zz, Lanes(-0.01917540471101196), Lanes(-0.050854078345862384));
  Lanes odd = fma(zz, Lanes(0.039230447784709195), Lanes(0.058581409048656254));
  even = fma(zz, even, Lanes(-0.06664510525508843));
  odd = fma(zz, odd, Lanes(0.07692183125376885));
  even = fma(zz, even, Lanes(-0.09090904575306488));
  odd = fma(zz, odd, Lanes(0.11111111015187018));
  even = fma(zz, even, Lanes(-0.14285714284665682));
  odd = fma(zz, odd, Lanes(0.19999999999995516));
  even = fma(zz, even, Lanes(-0.3333333333333333));
  Lanes angle = fma(t * z, fma(z, odd, even), t);
  constexpr double quarter_pi = 0x1.921fb54442d18p-1;
  angle = choose(steep, angle + Lanes(quarter_pi), angle);
  angle = choose(ay > ax, Lanes(2 * quarter_pi) - angle, angle);
  angle = choose(x < Lanes(0), Lanes(4 * quarter_pi) - angle, angle);
  return with_sign(angle, y);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
