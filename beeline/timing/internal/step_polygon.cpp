#include <algorithm>
#include <cmath>

#include <beeline/timing/internal/step_polygon.h>

namespace beeline::internal {
namespace {

constexpr double negligible =
    1e-10;  // of a limit: smaller coefficients bound nothing within rounding

}  // namespace

/// The edge that bounds x from above at y (side 1), or -x at -y mirrored (side -1).
StepPolygon::Edge StepPolygon::edge(double y, double side) const {
  Edge lowest;
  double smallest = std::numeric_limits<double>::max();
  const double signed_y = side * y;
  for (std::size_t i = 0; i < edges_; ++i) {
    const double x = p_[i] - m_[i] * signed_y;
    const bool lower = x < smallest;
    smallest = lower ? x : smallest;
    lowest.p = lower ? p_[i] : lowest.p;
    lowest.m = lower ? m_[i] : lowest.m;
  }
  lowest.m *= side;
  return lowest;
}

/// The y in `ends` at which the upper bound of side * x is largest, or the first found at which it
/// is at least `enough`. The bound is concave: the edges at both ends enclose its maximum.
double StepPolygon::max_vertex(SquaredSpeeds ends, double side, double enough) const {
  Edge right = edge(ends.max, side);
  if (right.m <= 0 || right.at(ends.max) >= enough) return ends.max;
  Edge left = edge(ends.min, side);
  if (left.m >= 0 || left.at(ends.min) >= enough) return ends.min;
  double y = ends.min;
  for (std::size_t i = 0; i < edges_; ++i) {
    y = std::clamp((right.p - left.p) / (right.m - left.m), ends.min, ends.max);
    const double top = left.at(y);
    const Edge between = edge(y, side);
    const double x = between.at(y);
    if (x >= top - 1e-14 * std::abs(top) || x >= enough) return y;
    (between.m > 0 ? right : left) = between;
  }
  return y;
}

/// Returns the largest y, up to this one, at which the polygon has an x, by Newton's method on the
/// difference of the concave upper and the convex lower bound, which are piecewise linear.
double StepPolygon::largest_feasible(double y) const {
  for (std::size_t i = 0; i < 2 * edges_; ++i) {
    const Edge upper = edge(y, 1), lower = edge(y, -1);
    if (upper.at(y) + lower.at(y) >= 0) return y;
    const double next = (upper.p + lower.p) / (upper.m + lower.m);
    if (!(next < y)) return y;
    y = next;
  }
  return y;
}

SquaredSpeeds StepPolygon::begins(SquaredSpeeds ends, double max_begin) {
  edges_ = 0;
  const double* begin = &constraints_.begin[first_];
  const double* end = &constraints_.end[first_];
  for (std::size_t i = 0; i < count_; ++i) {
    const double x = begin[i] * max_begin, y = end[i] * ends.max;
    if (std::abs(x) <= 1 && std::abs(y) <= 1 && std::abs(x + y) <= 1) continue;  // never active
    if (std::abs(x) > negligible) {
      p_[edges_] = 1 / std::abs(begin[i]);
      m_[edges_++] = end[i] / begin[i];
    } else {
      ends.max = std::min(ends.max, 1 / std::abs(end[i]));
    }
  }
  constexpr SquaredSpeeds impossible{1, 0};
  if (ends.none()) return impossible;
  if (ends.min > 0) {
    ends.max = largest_feasible(ends.max);
    if (ends.none()) return impossible;
  }
  double y = max_vertex(ends, 1, max_begin);
  if (ends.min == 0) {
    // If the maximum is beyond the largest possible y, the bound increases up to that y.
    const double possible = largest_feasible(y);
    if (possible < y) y = std::max(possible, 0.0);
    return {0, std::min(max_begin, std::max(edge(y, 1).at(y), 0.0))};
  }
  const double top = edge(y, 1).at(y);
  const double low = max_vertex(ends, -1, 0);
  return {std::max(0.0, -edge(low, -1).at(low)), std::min(max_begin, top)};
}

double StepPolygon::furthest_end(double x, SquaredSpeeds ends) const {
  double y = ends.max;
  const double* begin = &constraints_.begin[first_];
  const double* end = &constraints_.end[first_];
  for (std::size_t i = 0; i < count_; ++i) {
    const double here = begin[i] * x, step = end[i] * y;
    if (std::abs(here + step) <= 1 || std::abs(step) <= negligible) continue;
    y = std::min(y, end[i] > 0 ? (1 - here) / end[i] : (1 + here) / -end[i]);
  }
  return std::max(y, ends.min);
}

}  // namespace beeline::internal
