// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_INVERSE_SIX_PAIR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_INVERSE_SIX_PAIR_INL_H
#undef BEELINE_INVERSE_SIX_PAIR_INL_H
#else
#define BEELINE_INVERSE_SIX_PAIR_INL_H
#endif

#include <beeline/inverse/analytic/six_loop.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

/// The two equations w[i] . w + u[i] . u + rest[i] = 0 of one goal (see SixLoop::First), and the
/// two vectors on which joints f and d act: of a point, or of the parallel direction.
struct SixPair {
  double w[2][2], u[2][2], rest[2];
  double p[3];  ///< beyond joint f
  double x[3];  ///< before joint d
};

HWY_INLINE double dot(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// k[0] to k[3]: the motions before joints d, e, f and a.
HWY_NOINLINE static SixPair six_pair(const SixLoop& loop, const Rigid* k) {
  SixPair pair;
  const bool points = loop.family == SixLoop::Family::meeting;
  const Rigid &d = k[0], &e = k[1], &f = k[2], &a = k[3];
  double m[3];  // f's translation in the axes behind it
  const double r[3] = {e.rotation[0][2], e.rotation[1][2], e.rotation[2][2]};
  const double* t = e.translation;
  for (int i = 0; i < 3; ++i) {
    m[i] = f.rotation[0][i] * f.translation[0] + f.rotation[1][i] * f.translation[1] +
           f.rotation[2][i] * f.translation[2];
    pair.p[i] = points ? a.translation[i] : a.rotation[i][2];
    pair.x[i] = points
                    ? -(d.rotation[0][i] * d.translation[0] + d.rotation[1][i] * d.translation[1] +
                        d.rotation[2][i] * d.translation[2])
                    : d.rotation[2][i];
  }
  const double *p = pair.p, *x = pair.x, *z = f.rotation[2];
  double first = z[2] * p[2] - r[2] * x[2], second = m[2] * p[2] + t[2] * x[2];
  if (points) {
    first += f.translation[2] + dot(r, t);
    second += (dot(p, p) + dot(f.translation, f.translation) - dot(x, x) - dot(t, t)) / 2;
  } else {
    second += d.translation[2] + dot(p, a.translation) + loop.height;
  }
  // Joint f: p goes to p + t z (t and its square count), or is turned (cosine and sine count).
  if (loop.slides[2]) {
    first += z[0] * p[0] + z[1] * p[1];
    second += m[0] * p[0] + m[1] * p[1];
    pair.w[0][0] = points ? z[2] : 0, pair.w[0][1] = 0;
    pair.w[1][0] = points ? p[2] + m[2] : p[2], pair.w[1][1] = points ? 0.5 : 0;
  } else {
    pair.w[0][0] = z[0] * p[0] + z[1] * p[1], pair.w[0][1] = z[1] * p[0] - z[0] * p[1];
    pair.w[1][0] = m[0] * p[0] + m[1] * p[1], pair.w[1][1] = m[1] * p[0] - m[0] * p[1];
  }
  if (loop.slides[0]) {
    first -= r[0] * x[0] + r[1] * x[1];
    second += t[0] * x[0] + t[1] * x[1];
    pair.u[0][0] = points ? r[2] : 0, pair.u[0][1] = 0;
    pair.u[1][0] = points ? x[2] - t[2] : x[2], pair.u[1][1] = points ? -0.5 : 0;
  } else {
    pair.u[0][0] = -(r[0] * x[0] + r[1] * x[1]), pair.u[0][1] = -(r[0] * x[1] - r[1] * x[0]);
    pair.u[1][0] = t[0] * x[0] + t[1] * x[1], pair.u[1][1] = t[0] * x[1] - t[1] * x[0];
  }
  pair.rest[0] = first;
  pair.rest[1] = second;
  return pair;
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
