#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/draw/internal/outline.h>

namespace beeline::internal {
namespace {

double cross(const PaperPoint& a, const PaperPoint& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Returns the corners of the convex hull in order, with the interior on the side of larger angles
/// (Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979).
std::vector<PaperPoint> hull_of(std::vector<PaperPoint> points) {
  std::sort(points.begin(), points.end(), [](const PaperPoint& a, const PaperPoint& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<PaperPoint> hull;
  const auto add_chain = [&](const auto& begin, const auto& end) {
    const std::size_t first = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= first + 2 &&
             cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();  // the first corner of the other chain
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

/// The limits of a rectangle along x and y: where `sign * p[axis] <= limit`.
struct Side {
  int axis;
  double sign, limit;
  double outside(const PaperPoint& p) const { return sign * p[axis] - limit; }
};

std::vector<Side> sides_of(const PaperBox& box) {
  return {{0, -1, -box.low.x()}, {0, 1, box.high.x()}, {1, -1, -box.low.y()}, {1, 1, box.high.y()}};
}

}  // namespace

std::vector<PaperPoint> outline_of(std::vector<PaperPoint> points, double radius) {
  constexpr double step = std::numbers::pi / 18;
  const std::vector<PaperPoint> hull = hull_of(std::move(points));
  if (hull.empty() || !(radius > 0)) return hull;
  const auto edge_angle = [&](std::size_t i) {  // of the normal outwards
    const PaperPoint edge = hull[(i + 1) % hull.size()] - hull[i];
    return std::atan2(-edge.x(), edge.y());
  };
  std::vector<PaperPoint> outline;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const bool alone = hull.size() == 1;
    const double before = alone ? 0 : edge_angle((i + hull.size() - 1) % hull.size());
    double turn = alone ? 2 * std::numbers::pi : edge_angle(i) - before;
    if (turn < 0) turn += 2 * std::numbers::pi;
    const int steps = std::max(1, static_cast<int>(std::ceil(turn / step)));
    for (int k = 0; k <= steps; ++k) {
      if (alone && k == steps) break;
      const double angle = before + turn * k / steps;
      outline.emplace_back(hull[i] + radius * PaperPoint(std::cos(angle), std::sin(angle)));
    }
  }
  return outline;
}

std::vector<PaperPoint> clipped(std::vector<PaperPoint> polygon, const PaperBox& box) {
  for (const Side& side : sides_of(box)) {
    std::vector<PaperPoint> inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const PaperPoint &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
      const double a = side.outside(from), b = side.outside(to);
      if (a <= 0) inside.push_back(from);
      if ((a < 0 && b > 0) || (a > 0 && b < 0))
        inside.emplace_back(from + a / (a - b) * (to - from));
    }
    polygon = std::move(inside);
  }
  return polygon;
}

PaperPath clipped_edges(const std::vector<PaperPoint>& polygon, const PaperBox& box) {
  PaperPath path;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const PaperPoint &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    double begin = 0, end = 1;
    for (const Side& side : sides_of(box)) {
      const double a = side.outside(from), b = side.outside(to);
      if (a > 0 && b > 0) end = -1;
      if (a > 0 && b <= 0) begin = std::max(begin, a / (a - b));
      if (a <= 0 && b > 0) end = std::min(end, a / (a - b));
    }
    if (begin >= end) continue;
    path.move(from + begin * (to - from));
    path.line(from + end * (to - from));
  }
  return path;
}

}  // namespace beeline::internal
