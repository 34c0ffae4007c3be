#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace beeline::internal {

/// Returns the points, of first..last, that stay when no other is farther than `tolerance` from the
/// line between its kept neighbours: `distance(i, a, b)` is that of point i from the line from a to
/// b. The ends stay. Douglas & Peucker, "Algorithms for the reduction of the number of points"
/// (1973).
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
