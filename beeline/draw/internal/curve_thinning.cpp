#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/draw/internal/curve_thinning.h>

namespace beeline::internal {
namespace {

constexpr double strip = 0.5;      // width of a strip of which the extremes are kept, points
constexpr double tolerance = 0.1;  // points

/// Keeps the first, lowest, highest and last of each run of points within one vertical strip.
std::vector<PaperPoint> extremes(const std::vector<PaperPoint>& points) {
  std::vector<PaperPoint> kept;
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

double distance(const PaperPoint& p, const PaperPoint& a, const PaperPoint& b) {
  const PaperPoint chord = b - a;
  const double square = chord.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(chord) / square, 0.0, 1.0) : 0;
  return (p - a - t * chord).norm();
}

}  // namespace

std::vector<PaperPoint> thinned(const std::vector<PaperPoint>& points) {
  const std::vector<PaperPoint> all = extremes(points);
  if (all.size() < 3) return all;
  std::vector<bool> kept(all.size(), false);
  kept.front() = kept.back() = true;
  // Douglas & Peucker, "Algorithms for the reduction of the number of points" (1973).
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, all.size() - 1}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    double largest = tolerance;
    std::size_t farthest = begin;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double deviation = distance(all[i], all[begin], all[end]);
      if (deviation > largest) {
        largest = deviation;
        farthest = i;
      }
    }
    if (farthest == begin) continue;
    kept[farthest] = true;
    open.emplace_back(begin, farthest);
    open.emplace_back(farthest, end);
  }
  std::vector<PaperPoint> few;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (kept[i]) few.push_back(all[i]);
  }
  return few;
}

}  // namespace beeline::internal
