// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_INVERSE_PIEPER_EQUATIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_INVERSE_PIEPER_EQUATIONS_INL_H
#undef BEELINE_INVERSE_PIEPER_EQUATIONS_INL_H
#else
#define BEELINE_INVERSE_PIEPER_EQUATIONS_INL_H
#endif

#include <beeline/inverse/analytic/pieper_loop.h>

#include <beeline/inverse/analytic/rigid_motion-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {

using internal::PieperLoop;

/// The two equations w[i] . w + u[i] . u + constant[i] = 0 of one goal (see PieperLoop::First), and
/// the vectors that joints f and d move: the common point of axes a, b, c or their common
/// direction.
struct PieperEquations {
  double w[2][2], u[2][2], constant[2];
  double p[3];  ///< seen from joint f, before J_f
  double x[3];  ///< seen from joint d, as the base sees it
};

/// Fills in the equations; k[0] to k[3] are K_d, K_e, K_f, K_a. Let y = J_d^-1 x and s = J_f p. The
/// loop closes if J_e K_f s = K_e^-1 y. J_e leaves the height along axis e and the length of that
/// vector unchanged. The first equation compares the heights. The second compares half the squared
/// lengths (points) or the heights of the parallel links (directions).
HWY_INLINE PieperEquations pieper_equations(const PieperLoop& loop, const RigidMotion* k) {
  PieperEquations equations;
  const bool points = loop.family == PieperLoop::Family::intersecting;
  const RigidMotion &d = k[0], &e = k[1], &f = k[2], &a = k[3];
  double m[3];  // translation of K_f in its own axes
  const double r[3] = {e.rotation[0][2], e.rotation[1][2], e.rotation[2][2]};
  const double* t = e.translation;
  for (int i = 0; i < 3; ++i) {
    m[i] = f.rotation[0][i] * f.translation[0] + f.rotation[1][i] * f.translation[1] +
           f.rotation[2][i] * f.translation[2];
    equations.p[i] = points ? a.translation[i] : a.rotation[i][2];
    equations.x[i] =
        points ? -(d.rotation[0][i] * d.translation[0] + d.rotation[1][i] * d.translation[1] +
                   d.rotation[2][i] * d.translation[2])
               : d.rotation[2][i];
  }
  const double *p = equations.p, *x = equations.x, *z = f.rotation[2];
  double first = z[2] * p[2] - r[2] * x[2], second = m[2] * p[2] + t[2] * x[2];
  if (points) {
    first += f.translation[2] + dot(r, t);
    second += (dot(p, p) + dot(f.translation, f.translation) - dot(x, x) - dot(t, t)) / 2;
  } else {
    second += d.translation[2] + dot(p, a.translation) + loop.height;
  }
  auto& w = equations.w;
  if (loop.prismatic[2]) {  // w = (displacement, its square)
    first += z[0] * p[0] + z[1] * p[1];
    second += m[0] * p[0] + m[1] * p[1];
    w[0][0] = points ? z[2] : 0;
    w[0][1] = 0;
    w[1][0] = points ? p[2] + m[2] : p[2];
    w[1][1] = points ? 0.5 : 0;
  } else {  // w = (cos, sin)
    w[0][0] = z[0] * p[0] + z[1] * p[1];
    w[0][1] = z[1] * p[0] - z[0] * p[1];
    w[1][0] = m[0] * p[0] + m[1] * p[1];
    w[1][1] = m[1] * p[0] - m[0] * p[1];
  }
  auto& u = equations.u;
  if (loop.prismatic[0]) {
    first -= r[0] * x[0] + r[1] * x[1];
    second += t[0] * x[0] + t[1] * x[1];
    u[0][0] = points ? r[2] : 0;
    u[0][1] = 0;
    u[1][0] = points ? x[2] - t[2] : x[2];
    u[1][1] = points ? -0.5 : 0;
  } else {
    u[0][0] = -(r[0] * x[0] + r[1] * x[1]);
    u[0][1] = -(r[0] * x[1] - r[1] * x[0]);
    u[1][0] = t[0] * x[0] + t[1] * x[1];
    u[1][1] = t[0] * x[1] - t[1] * x[0];
  }
  equations.constant[0] = first;
  equations.constant[1] = second;
  return equations;
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
