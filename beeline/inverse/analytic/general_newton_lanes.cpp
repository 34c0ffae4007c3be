#include <beeline/inverse/analytic/general_newton.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/analytic/general_newton_lanes.cpp"
#include <hwy/foreach_target.h>  // must come before the -inl headers

#include <beeline/simd/geometry-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

HWY_INLINE Vector combined(Lanes s, const Vector& a, Lanes t, const Vector& b) {
  return fma(s, a, t * b);
}
HWY_INLINE void add(Vector& sum, Lanes s, const Vector& a) { sum = fma(s, a, sum); }

/// The axes and the last frame of eight configurations.
struct Stance {
  Vector axis[6], origin[6];
  Vector x, y, z;
};

HWY_NOINLINE void stand(const SixLinks& six, const Lanes* q, Stance& stance) {
  Vector x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, p{0, 0, 0};
  for (int i = 0; i < 6; ++i) {
    add(p, six.step[i][0], x);
    add(p, six.step[i][1], y);
    add(p, six.step[i][2], z);
    const Vector y_before = y;
    y = combined(six.cos_alpha[i], y_before, six.sin_alpha[i], z);
    z = combined(-six.sin_alpha[i], y_before, six.cos_alpha[i], z);
    Lanes s, c;
    sine_cosine(q[i] + Lanes(six.rest[i]), s, c);
    const Vector x_before = x;
    x = combined(c, x_before, s, y);
    y = combined(-s, x_before, c, y);
    stance.axis[i] = z;
    stance.origin[i] = p;
  }
  stance.x = x;
  stance.y = y;
  stance.z = z;
}

/// J dq = e by Householder reflections: needs no pivots, hence no branches. Gives dq in e.
HWY_NOINLINE void solve(Lanes (*J)[6], Lanes* e) {  // J[column][row]
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
}

constexpr int usual_steps = 8;  // those that come near at all are near by then
constexpr int max_steps = 40;   // where two solutions merge, each step only halves the error
constexpr double near_enough = 1e-3;
constexpr double longest_step = 0.3;

unsigned newton_lanes(const SixLinks& six, const Motion& goal, int last, double tolerance,
                      EightConfigurations& eight) {
  Lanes q[6];
  for (int i = 0; i < 6; ++i) q[i] = Lanes::load(eight.q[i]);
  const auto& r = goal.rotation;
  const Vector goal_x{r[0][0], r[1][0], r[2][0]}, goal_y{r[0][1], r[1][1], r[2][1]},
      goal_z{r[0][2], r[1][2], r[2][2]};
  const Vector goal_p{goal.translation[0], goal.translation[1], goal.translation[2]};

  Stance at;
  q[last] = Lanes(0);
  stand(six, q, at);
  // What remains is a turn about the axis by this angle: trace = 1 + 2 cos.
  Vector skew = cross(at.x, goal_x);
  add(skew, 1, cross(at.y, goal_y));
  add(skew, 1, cross(at.z, goal_z));
  const Lanes trace = dot(at.x, goal_x) + dot(at.y, goal_y) + dot(at.z, goal_z);
  q[last] = arc_tangent(dot(skew, at.axis[last]), trace - Lanes(1));

  for (int step = 0;; ++step) {
    stand(six, q, at);
    const Vector p = goal_p - at.origin[5];
    Vector w = cross(at.x, goal_x);
    add(w, 1, cross(at.y, goal_y));
    add(w, 1, cross(at.z, goal_z));
    Lanes e[6] = {p.x, p.y, p.z, Lanes(0.5) * w.x, Lanes(0.5) * w.y, Lanes(0.5) * w.z};
    Lanes error(0);
    for (const Lanes& part : e) error = max(error, abs(part));
    // The skew part of a half turn vanishes, too.
    const LaneMask upright = dot(at.x, goal_x) + dot(at.y, goal_y) + dot(at.z, goal_z) > Lanes(2);
    const LaneMask arrived = (error < Lanes(tolerance)) & upright;
    const LaneMask coming = (error < Lanes(near_enough)) & !arrived;
    if (step == max_steps || bits(arrived) == 0xff || (step >= usual_steps && bits(coming) == 0)) {
      for (int i = 0; i < 6; ++i) q[i].store(eight.q[i]);
      return bits(arrived);
    }
    Lanes J[6][6];
    for (int i = 0; i < 6; ++i) {
      const Vector linear = cross(at.axis[i], at.origin[5] - at.origin[i]);
      const Lanes column[6] = {linear.x,     linear.y,     linear.z,
                               at.axis[i].x, at.axis[i].y, at.axis[i].z};
      for (int k = 0; k < 6; ++k) J[i][k] = column[k];
    }
    solve(J, e);
    Lanes longest(0);
    for (const Lanes& part : e) longest = max(longest, abs(part));
    const Lanes share = choose(arrived, Lanes(0), Lanes(longest_step) / max(longest, longest_step));
    for (int i = 0; i < 6; ++i) q[i] = fma(share, e[i], q[i]);
  }
}

}  // namespace

unsigned newton_kernel(const SixLinks& six, const Motion& goal, int last, double tolerance,
                       EightConfigurations& eight) {
  return newton_lanes(six, goal, last, tolerance, eight);
}

}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace beeline {

HWY_EXPORT(newton_kernel);

unsigned newton(const SixLinks& six, const Motion& goal, int last, double tolerance,
                EightConfigurations& eight) {
  return HWY_DYNAMIC_DISPATCH(newton_kernel)(six, goal, last, tolerance, eight);
}

}  // namespace beeline
#endif
