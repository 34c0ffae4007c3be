#include <beeline/inverse/analytic/raghavan_roth_newton.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/analytic/raghavan_roth_newton_lanes.cpp"
#include <hwy/foreach_target.h>  // must come before the -inl headers

#include <beeline/inverse/analytic/rigid_motion-inl.h>
#include <beeline/simd/geometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using internal::EightConfigurations;
using internal::RevoluteLinks;

/// The joint axes and the last frame of eight configurations.
struct JointAxes {
  Vector axis[6], origin[6];
  LanePose last;
};

HWY_NOINLINE void forward(const RevoluteLinks& links, const Lanes* q, JointAxes& axes) {
  LanePose frame = LanePose::identity();
  for (int i = 0; i < 6; ++i) {
    frame.origin =
        combined(frame, links.translation[i][0], links.translation[i][1], links.translation[i][2]) +
        frame.origin;
    frame = rotated_x(frame, links.cos_alpha[i], links.sin_alpha[i]);
    Lanes s, c;
    sine_cosine(q[i] + Lanes(links.theta_offset[i]), s, c);
    frame = rotated_z(frame, {c, s});
    axes.axis[i] = frame.z;
    axes.origin[i] = frame.origin;
  }
  axes.last = frame;
}

/// Solves J dq = e by Householder reflections, which need no pivoting and hence no branches. Writes
/// dq to e. It is undamped, unlike the solver of the numerical method, because the candidates start
/// close to the solutions, and convergence has to be quadratic. `J[column][row]`. Returns det J.
HWY_INLINE Lanes solve(Lanes (*J)[6], Lanes* e) {
  Lanes diagonal[6];
  for (int k = 0; k < 6; ++k) {
    Lanes square(0);
    for (int r = k; r < 6; ++r) square = fma(J[k][r], J[k][r], square);
    const Lanes length = sqrt(square);
    const Lanes head = J[k][k] + with_sign(length, J[k][k]);
    diagonal[k] = -with_sign(max(length, Lanes(1e-17)), J[k][k]);
    const Lanes scale = Lanes(1) / max(abs(head * length), Lanes(1e-300));
    J[k][k] = head;
    for (int column = k + 1; column <= 6; ++column) {
      Lanes* to = column < 6 ? J[column] : e;
      Lanes along(0);
      for (int r = k; r < 6; ++r) along = fma(J[k][r], to[r], along);
      along *= scale;
      for (int r = k; r < 6; ++r) to[r] = fnma(along, J[k][r], to[r]);
    }
  }
  for (int k = 5; k >= 0; --k) {
    for (int column = k + 1; column < 6; ++column) e[k] = fnma(J[column][k], e[column], e[k]);
    e[k] = e[k] / diagonal[k];
  }
  // The six reflections have the determinant 1 together.
  return diagonal[0] * diagonal[1] * diagonal[2] * diagonal[3] * diagonal[4] * diagonal[5];
}

/// Takes one Newton step from the given axes with the error e, at most max_step in each joint.
/// Lanes that have converged do not move. Returns the determinant of the Jacobian before the step.
HWY_INLINE Lanes step_towards(const JointAxes& axes, Lanes* e, LaneMask converged, Lanes* q) {
  // Radians. A longer step leaves the neighbourhood in which the linear model holds.
  constexpr double max_step = 0.3;
  Lanes J[6][6];
  for (int i = 0; i < 6; ++i) {
    const Vector& angular = axes.axis[i];
    const Vector linear = cross(angular, axes.last.origin - axes.origin[i]);
    const Lanes column[6] = {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
    for (int k = 0; k < 6; ++k) J[i][k] = column[k];
  }
  const Lanes determinant = solve(J, e);
  Lanes longest(0);
  for (int i = 0; i < 6; ++i) longest = max(longest, abs(e[i]));
  const Lanes scale = choose(converged, Lanes(0), Lanes(max_step) / max(longest, max_step));
  for (int i = 0; i < 6; ++i) q[i] = fma(scale, e[i], q[i]);
  return determinant;
}

/// Returns the sum of the cross products of the axes of two frames: 2 sin(angle) times the axis of
/// the rotation from a to b.
HWY_INLINE Vector skew_part(const LanePose& a, const LanePose& b) {
  return cross(a.x, b.x) + cross(a.y, b.y) + cross(a.z, b.z);
}

/// Returns the trace of the rotation from a to b: 1 + 2 cos(angle).
HWY_INLINE Lanes trace(const LanePose& a, const LanePose& b) {
  return dot(a.x, b.x) + dot(a.y, b.y) + dot(a.z, b.z);
}

}  // namespace

unsigned newton_kernel(const RevoluteLinks& links, const RigidMotion& goal_motion, int last,
                       double tolerance, EightConfigurations& eight) {
  constexpr int usual_steps = 8;  // a candidate near a solution has an error below `near` by then
  constexpr int max_steps = 40;   // at a double solution each step only halves the error
  constexpr double near = 1e-3;
  Lanes q[6];
  for (int i = 0; i < 6; ++i) q[i] = Lanes::load(eight.q[i]);
  const LanePose goal = space(goal_motion);

  JointAxes axes;
  q[last] = Lanes(0);
  forward(links, q, axes);
  q[last] = arc_tangent(dot(skew_part(axes.last, goal), axes.axis[last]),
                        trace(axes.last, goal) - Lanes(1));
  for (int step = 0;; ++step) {
    forward(links, q, axes);
    const Vector p = goal.origin - axes.last.origin, w = skew_part(axes.last, goal);
    Lanes e[6] = {p.x, p.y, p.z, Lanes(0.5) * w.x, Lanes(0.5) * w.y, Lanes(0.5) * w.z};
    Lanes error(0);
    for (const Lanes& part : e) error = max(error, abs(part));
    // The skew part vanishes also for a rotation by pi, whose trace is -1.
    const Lanes along = trace(axes.last, goal);
    if (step == 0) choose(along <= Lanes(1), Lanes(1), error).store(eight.error);
    const LaneMask same_side = along > Lanes(2);
    const LaneMask converged = (error < Lanes(tolerance)) & same_side;
    const LaneMask converging = (error < Lanes(near)) & !converged;
    const bool done = step > 0 && bits(converged) == 0xff;  // a step computes the determinant
    if (done || step == max_steps || (step >= usual_steps && bits(converging) == 0)) {
      for (int i = 0; i < 6; ++i) q[i].store(eight.q[i]);
      return bits(converged);
    }
    step_towards(axes, e, converged, q).store(eight.determinant);
  }
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(newton_kernel);

namespace internal {

unsigned newton(const RevoluteLinks& links, const RigidMotion& goal, int last, double tolerance,
                EightConfigurations& eight) {
  return HWY_DYNAMIC_DISPATCH(newton_kernel)(links, goal, last, tolerance, eight);
}

}  // namespace internal
}  // namespace beeline
#endif
