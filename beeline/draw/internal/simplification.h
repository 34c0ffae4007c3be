#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace beeline::internal {

/// The distance of a point of the plane or of space from the chord from a to b.
template <class Point>
double distance_from_chord(const Point& p, const Point& a, const Point& b) {
  const Point chord = b - a;
  const double square = chord.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(chord) / square, 0.0, 1.0) : 0;
  return (p - a - t * chord).norm();
}

/// Returns the points of first..last to keep, such that no other point is farther than `tolerance`
/// from the line between its kept neighbours. `distance(i, a, b)` is the distance of point i from
/// the line from a to b. The ends are kept. Douglas & Peucker, "Algorithms for the reduction of the
/// number of points" (1973).
std::vector<std::size_t> simplified(std::size_t first, std::size_t last, double tolerance,
                                    const auto& distance) {
  std::vector<std::size_t> kept{first};
  if (last > first) kept.push_back(last);
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    double largest = tolerance;
    std::size_t farthest = a;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double off = distance(i, a, b);
      if (off > largest) {
        largest = off;
        farthest = i;
      }
    }
    if (farthest == a) continue;
    kept.push_back(farthest);
    open.emplace_back(a, farthest);
    open.emplace_back(farthest, b);
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

}  // namespace beeline::internal
