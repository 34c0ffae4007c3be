#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/draw/chart_curve.h>

namespace beeline {
namespace {

constexpr double strip = 0.5;      // points wide, of which the extremes are kept
constexpr double tolerance = 0.1;  // points

/// Of each run of points within one upright strip: the first, the lowest, the highest, the last.
std::vector<Point> extremes(const std::vector<Point>& points) {
  std::vector<Point> kept;
  for (std::size_t begin = 0; begin < points.size();) {
    const double at = std::floor(points[begin].x() / strip);
    std::size_t end = begin + 1;
    while (end < points.size() && std::floor(points[end].x() / strip) == at) ++end;
    std::size_t low = begin, high = begin;
    for (std::size_t i = begin; i < end; ++i) {
      if (points[i].y() < points[low].y()) low = i;
      if (points[i].y() > points[high].y()) high = i;
    }
    std::vector<std::size_t> few{begin, std::min(low, high), std::max(low, high), end - 1};
    few.erase(std::unique(few.begin(), few.end()), few.end());
    for (const std::size_t i : few) kept.push_back(points[i]);
    begin = end;
  }
  return kept;
}

double distance(const Point& p, const Point& a, const Point& b) {
  const Point way = b - a;
  const double square = way.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(way) / square, 0.0, 1.0) : 0;
  return (p - a - t * way).norm();
}

}  // namespace

std::vector<Point> thinned(const std::vector<Point>& points) {
  const std::vector<Point> all = extremes(points);
  if (all.size() < 3) return all;
  std::vector<bool> kept(all.size(), false);
  kept.front() = kept.back() = true;
  // Douglas and Peucker, 1973.
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, all.size() - 1}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    double most = tolerance;
    std::size_t farthest = begin;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double off = distance(all[i], all[begin], all[end]);
      if (off > most) most = off, farthest = i;
    }
    if (farthest == begin) continue;
    kept[farthest] = true;
    open.emplace_back(begin, farthest);
    open.emplace_back(farthest, end);
  }
  std::vector<Point> few;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kept[i]) few.push_back(all[i]);
  }
  return few;
}

}  // namespace beeline
