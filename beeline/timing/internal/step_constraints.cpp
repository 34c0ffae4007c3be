#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <beeline/timing/internal/step_constraints.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/timing/internal/step_constraints.cpp"
#include <hwy/foreach_target.h>

#include <beeline/simd/lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using internal::SquaredSpeeds;
using internal::StepConstraints;

constexpr double near_limit = 0.9;    // of a squared velocity limit; steps are not checked below
constexpr double negligible = 1e-10;  // of a limit: smaller terms bound nothing within rounding
constexpr double unbounded = std::numeric_limits<double>::max();

/// The first `count` of up to eight numbers, zero in the other lanes.
struct Joints {
  std::size_t first;
  int count;

  HWY_INLINE Joints(std::size_t at, std::size_t joints)
      : first(at),
        count(static_cast<int>(std::min<std::size_t>(lane_count, joints - std::min(at, joints)))) {}
  HWY_INLINE Lanes of(const Configuration& q) const {
    return Lanes::load_first(q.data() + first, count);
  }
};

/// The constraints of step k as coefficients of x and of y, in place of p and m of the edges; its
/// slope in the middle of the quintic through its ends.
HWY_INLINE void set_step(const JointPath& path, std::size_t k, double usable,
                         StepConstraints& constraints) {
  const double h = path.s[k + 1] - path.s[k], inverse = 1 / h;
  const Lanes half(0.5 * inverse), by_h(inverse), h_32(h / 32), scale(1 / usable);
  const std::size_t width = constraints.width;
  double* begin = constraints.edges_of(k);
  double* end = begin + constraints.constraints();
  Lanes slowest[3] = {0, 0, 0};  // inverse of the speed at each quarter of the step
  for (std::size_t i = 0; i < width; i += lane_count) {
    const Joints joints(i, constraints.joints);
    const Lanes d0 = joints.of(path.dq[k]), d1 = joints.of(path.dq[k + 1]);
    const Lanes c0 = joints.of(path.ddq[k]), c1 = joints.of(path.ddq[k + 1]);
    const Lanes chord = (joints.of(path.q[k + 1]) - joints.of(path.q[k])) * by_h;
    const Lanes mid = fnma(h_32, c0 - c1, fnma(Lanes(0.4375), d0 + d1, Lanes(1.875) * chord));
    const Lanes mid_ddq = fnma(Lanes(0.25), c0 + c1, Lanes(1.5) * by_h * (d1 - d0));
    mid.store(&constraints.middle[k * width + i]);
    const Lanes force = scale * Lanes::load(&constraints.inverse_acceleration[i]);
    const Lanes e0 = d0 * half, e = mid * (half + half), e1 = d1 * half;  // q' / 2h; q' / h
    const Lanes x0 = c0 - e0, y1 = c1 + e1;
    (x0 * force).store(begin + i);
    (e0 * force).store(end + i);
    (fnma(Lanes(0.5), x0 - e1, mid_ddq - e) * force).store(begin + width + i);
    (fnma(Lanes(0.5), e0 + y1, mid_ddq + e) * force).store(end + width + i);
    (-e1 * force).store(begin + 2 * width + i);
    (y1 * force).store(end + 2 * width + i);
    const Lanes slow = Lanes::load(&constraints.slowness[i]), three = Lanes(0.75) * mid;
    const Lanes first = fma(Lanes(0.375), d0, fnma(Lanes(0.125), d1, three));
    const Lanes third = fma(Lanes(0.375), d1, fnma(Lanes(0.125), d0, three));
    slowest[0] = max(slowest[0], abs(first) * slow);
    slowest[1] = max(slowest[1], abs(mid) * slow);
    slowest[2] = max(slowest[2], abs(third) * slow);
  }
  for (std::size_t j = 0; j < 3; ++j) {
    const double u = 0.25 * double(j + 1), root = largest_of(slowest[j]), square = root * root;
    begin[j * width + constraints.joints] = (1 - u) * square;
    end[j * width + constraints.joints] = u * square;
  }
}

/// Replaces the coefficients of step k by its edges.
HWY_INLINE void set_edges(std::size_t k, StepConstraints& constraints) {
  const std::size_t count = constraints.constraints();
  const Lanes max_begin(constraints.largest[k]), none(unbounded);
  double* p = constraints.edges_of(k);
  Lanes max_end = none;
  for (std::size_t i = 0; i < count; i += lane_count, p += lane_count) {
    const Lanes begin = Lanes::load(p), end = Lanes::load(p + count);
    const LaneMask tiny = abs(begin) * max_begin <= Lanes(negligible);
    const Lanes by_begin = Lanes(1) / begin, by_end = Lanes(1) / end;
    const Lanes w = abs(by_end);
    choose(tiny, none, abs(by_begin)).store(p);
    choose(tiny, Lanes(0), end * by_begin).store(p + count);
    w.store(p + 2 * count);
    (begin * by_end).store(p + 3 * count);
    max_end = min(max_end, choose(tiny, w, none));
  }
  constraints.max_end[k] = smallest_of(max_end);
}

void set_steps(const JointPath& path, const PathLimits& limits, double fastest, std::size_t from,
               std::size_t to, StepConstraints& constraints) {
  for (std::size_t k = from; k <= to; ++k) {
    Lanes slowest(limits.speed.empty() ? 0 : 1 / limits.speed[k]);
    for (std::size_t i = 0; i < constraints.width; i += lane_count) {
      const Lanes dq = Joints(i, constraints.joints).of(path.dq[k]);
      slowest = max(slowest, abs(dq) * Lanes::load(&constraints.slowness[i]));
    }
    const double root = largest_of(slowest);
    constraints.largest[k] = std::min(fastest, 1 / (root * root));
  }
  const auto& fraction = limits.fraction;
  for (std::size_t k = from; k < to; ++k) {
    const double usable = fraction.empty() ? 1 : std::min(fraction[k], fraction[k + 1]);
    set_step(path, k, usable, constraints);
  }
  for (std::size_t k = from; k < to; ++k) set_edges(k, constraints);
}

/// An edge x <= p - m y, or x >= -p - m y.
struct Edge {
  double p = unbounded, m = 0;
  HWY_INLINE double at(double y) const { return p - m * y; }
};

/// A point on the boundary, and an edge there.
struct Vertex {
  double y;
  Edge edge;
};

/// The polygon of the x and y of one step that satisfy the constraints.
struct StepPolygon {
  const double* p;
  const double* m;
  std::size_t count;

  HWY_INLINE StepPolygon(const StepConstraints& constraints, std::size_t k)
      : p(constraints.edges_of(k)),
        m(p + constraints.constraints()),
        count(constraints.constraints()) {}

  /// The edge that bounds x from above at y (side 1), or -x at -y mirrored (side -1).
  HWY_INLINE Edge edge(double y, double side) const {
    const Lanes signed_y(side * y);
    Lanes lowest(unbounded);
    for (std::size_t i = 0; i < count; i += lane_count) lowest = min(lowest, bound(i, signed_y));
    const Lanes smallest(smallest_of(lowest));
    for (std::size_t i = 0; i < count; i += lane_count) {
      const unsigned which = bits(bound(i, signed_y) == smallest);
      if (which == 0) continue;
      const std::size_t k = i + static_cast<std::size_t>(std::countr_zero(which));
      return {p[k], side * m[k]};
    }
    return {};
  }

  HWY_INLINE Lanes bound(std::size_t i, Lanes y) const {
    return fnma(Lanes::load(m + i), y, Lanes::load(p + i));
  }

  /// The y in `ends` at which the upper bound of side * x is largest, or the first found at which
  /// it is at least `enough`. The bound is concave: the edges at both ends enclose its maximum.
  HWY_INLINE Vertex max_vertex(SquaredSpeeds ends, double side, double enough) const {
    Edge right = edge(ends.max, side);
    if (right.m <= 0 || right.at(ends.max) >= enough) return {ends.max, right};
    Edge left = edge(ends.min, side);
    if (left.m >= 0 || left.at(ends.min) >= enough) return {ends.min, left};
    Vertex vertex{ends.min, left};
    for (std::size_t i = 0; i < count; ++i) {
      const double y = std::clamp((right.p - left.p) / (right.m - left.m), ends.min, ends.max);
      const double top = left.at(y);
      vertex = {y, edge(y, side)};
      const double x = vertex.edge.at(y);
      if (x >= top - 1e-14 * std::abs(top) || x >= enough) break;
      (vertex.edge.m > 0 ? right : left) = vertex.edge;
    }
    return vertex;
  }

  /// Returns the largest y, up to the vertex, at which the polygon has an x, by Newton's method on
  /// the difference of the concave upper and the convex lower bound, which are piecewise linear.
  HWY_INLINE Vertex largest_feasible(Vertex vertex) const {
    for (std::size_t i = 0; i < 2 * count; ++i) {
      const auto& [y, upper] = vertex;
      const Edge lower = edge(y, -1);
      if (upper.at(y) + lower.at(y) >= 0) break;
      const double next = (upper.p + lower.p) / (upper.m + lower.m);
      if (!(next < y)) break;
      vertex = {next, edge(next, 1)};
    }
    return vertex;
  }

  /// Returns the interval of x, up to `max_begin`, from which some y in `ends` can be reached.
  HWY_INLINE SquaredSpeeds begins(SquaredSpeeds ends, double max_begin) const {
    constexpr SquaredSpeeds impossible{1, 0};
    if (ends.none()) return impossible;
    if (ends.min > 0) {
      ends.max = largest_feasible({ends.max, edge(ends.max, 1)}).y;
      if (ends.none()) return impossible;
      const Vertex high = max_vertex(ends, 1, max_begin), low = max_vertex(ends, -1, 0);
      return {std::max(0.0, -low.edge.at(low.y)), std::min(max_begin, high.edge.at(high.y))};
    }
    // If the maximum is beyond the largest possible y, the bound increases up to that y.
    Vertex high = largest_feasible(max_vertex(ends, 1, max_begin));
    if (high.y < 0) high = {0, edge(0, 1)};
    return {0, std::min(max_begin, std::max(high.edge.at(high.y), 0.0))};
  }
};

std::size_t controllable(const StepConstraints& constraints, std::size_t from, std::size_t to,
                         SquaredSpeeds* speeds) {
  for (std::size_t k = to; k-- > from;) {
    const SquaredSpeeds ends{speeds[k + 1].min,
                             std::min(speeds[k + 1].max, constraints.max_end[k])};
    speeds[k] = StepPolygon(constraints, k).begins(ends, constraints.largest[k]);
    if (speeds[k].none()) return k;
  }
  return to;
}

std::size_t furthest(const StepConstraints& constraints, std::size_t from, std::size_t to,
                     const SquaredSpeeds* controllable, double* b) {
  const std::size_t count = constraints.constraints();
  for (std::size_t k = from; k < to; ++k) {
    const SquaredSpeeds ends = controllable[k + 1];
    const double* w = constraints.edges_of(k) + 2 * count;
    const Lanes x(b[k]), max_end(ends.max), max_w(ends.max / negligible);
    Lanes y = max_end;
    for (std::size_t i = 0; i < count; i += lane_count) {
      const Lanes at_zero = Lanes::load(w + i);
      const Lanes bound = fnma(Lanes::load(w + count + i), x, at_zero);
      y = min(y, choose(at_zero < max_w, bound, max_end));
    }
    b[k + 1] = std::max(smallest_of(y), ends.min);
    if (!(b[k] + b[k + 1] > 0)) return k;
  }
  return to;
}

double velocity_fraction(const JointPath& path, const StepConstraints& constraints,
                         std::size_t from, std::size_t to, const double* b) {
  Lanes largest(0);
  for (std::size_t k = from; k < to; ++k) {
    const Lanes higher(std::max(b[k], b[k + 1]));
    for (std::size_t i = 0; i < constraints.width; i += lane_count) {
      const Joints joints(i, constraints.joints);
      const Lanes d0 = joints.of(path.dq[k]), d1 = joints.of(path.dq[k + 1]);
      const Lanes mid = Lanes::load(&constraints.middle[k * constraints.width + i]);
      const Lanes slow = Lanes::load(&constraints.slowness[i]), scale = slow * slow;
      const LaneMask near =
          max(max(d0 * d0, mid * mid), d1 * d1) * scale * higher >= Lanes(near_limit);
      if (bits(near) == 0) continue;
      for (const double x : {0.125, 0.375, 0.625, 0.875}) {
        const Lanes slope = fma(Lanes((1 - x) * (1 - 2 * x)), d0,
                                fma(Lanes(4 * x * (1 - x)), mid, Lanes(x * (2 * x - 1)) * d1));
        const Lanes used = slope * slope * scale * Lanes((1 - x) * b[k] + x * b[k + 1]);
        largest = max(largest, choose(near, used, Lanes(0)));
      }
    }
  }
  return largest_of(largest);
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace beeline {

HWY_EXPORT(set_steps);
HWY_EXPORT(controllable);
HWY_EXPORT(furthest);
HWY_EXPORT(velocity_fraction);

namespace internal {

void begin_constraints(const JointPath& path, const PathLimits& limits,
                       StepConstraints& constraints) {
  constexpr std::size_t lanes = 8;
  const std::size_t joints = static_cast<std::size_t>(limits.velocity.size());
  const std::size_t steps = path.size() - 1;
  constraints.joints = joints;
  constraints.width = (joints / lanes + 1) * lanes;
  constraints.slowness.assign(constraints.width, 0);
  constraints.inverse_acceleration.assign(constraints.width, 0);
  for (std::size_t i = 0; i < joints; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    constraints.slowness[i] = 1 / limits.velocity[k];
    constraints.inverse_acceleration[i] = 1 / limits.acceleration[k];
  }
  constraints.largest.resize(steps + 1);
  constraints.max_end.resize(steps);
  constraints.middle.resize(steps * constraints.width);
  constraints.edges.resize(4 * constraints.constraints() * steps);
}

void set_constraints(const JointPath& path, const PathLimits& limits, double fastest,
                     std::size_t from, std::size_t to, StepConstraints& constraints) {
  HWY_DYNAMIC_DISPATCH(set_steps)(path, limits, fastest, from, to, constraints);
}

std::size_t controllable_speeds(const StepConstraints& constraints, std::size_t from,
                                std::size_t to, SquaredSpeeds* speeds) {
  return HWY_DYNAMIC_DISPATCH(controllable)(constraints, from, to, speeds);
}

std::size_t largest_speeds(const StepConstraints& constraints, std::size_t from, std::size_t to,
                           const SquaredSpeeds* controllable, double* b) {
  return HWY_DYNAMIC_DISPATCH(furthest)(constraints, from, to, controllable, b);
}

double squared_velocity_fraction(const JointPath& path, const StepConstraints& constraints,
                                 std::size_t from, std::size_t to, const double* b) {
  return HWY_DYNAMIC_DISPATCH(velocity_fraction)(path, constraints, from, to, b);
}

}  // namespace internal
}  // namespace beeline

#endif
