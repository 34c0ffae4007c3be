#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/curve_thinning.h>
#include <beeline/draw/internal/simplification.h>

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

}  // namespace

std::vector<PaperPoint> thinned(const std::vector<PaperPoint>& points) {
  const std::vector<PaperPoint> all = extremes(points);
  if (all.size() < 3) return all;
  const auto off = [&](std::size_t i, std::size_t a, std::size_t b) {
    return distance_from_chord(all[i], all[a], all[b]);
  };
  std::vector<PaperPoint> few;
  for (const std::size_t i : simplified(0, all.size() - 1, tolerance, off)) few.push_back(all[i]);
  return few;
}

}  // namespace beeline::internal
