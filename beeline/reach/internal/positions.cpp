#include <limits>

#include <beeline/reach/internal/positions.h>

namespace beeline::internal {

void check_positions(const ReachGrid& grid, Eigen::Index first, Eigen::Index last) {
  if (first >= 0 && first <= last && last <= grid.positions()) return;
  throw Error("positions " + std::to_string(first) + " to " + std::to_string(last) +
              " of a map that has " + std::to_string(grid.positions()));
}

ReachCells part_of(const ReachCells& cells, Eigen::Index first, Eigen::Index last) {
  const auto part = [first, last](const auto& values) {
    return std::decay_t<decltype(values)>(values.begin() + first, values.begin() + last);
  };
  return {part(cells.branches), part(cells.manipulability), part(cells.margin)};
}

void check_complete(const ReachMap& map) {
  if (!map.complete()) throw FileError(map.path(), 0, "is incomplete: merge its parts first");
}

void for_each_block(const std::array<ReachAxis, 3>& axes,
                    const std::function<void(const std::vector<Vector3>&)>& use) {
  constexpr std::size_t most = std::size_t{1} << 21;
  std::vector<Vector3> centres;
  for (Eigen::Index x = 0; x < axes[0].cells; ++x) {
    for (Eigen::Index y = 0; y < axes[1].cells; ++y) {
      for (Eigen::Index z = 0; z < axes[2].cells; ++z) {
        centres.emplace_back(axes[0].centre(x), axes[1].centre(y), axes[2].centre(z));
        if (centres.size() < most) continue;
        use(centres);
        centres.clear();
      }
    }
  }
  if (!centres.empty()) use(centres);
}

ReachPositions positions_at(const ReachMap& map, const std::vector<Vector3>& points) {
  check_complete(map);
  constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
  ReachPositions all{std::vector<float>(points.size()), std::vector<std::uint8_t>(points.size()),
                     std::vector<float>(points.size(), unknown),
                     std::vector<float>(points.size(), unknown)};
  std::vector<std::pair<Eigen::Index, std::size_t>> wanted;  // a position and its point, in order
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (const auto p = map.grid().position_of(points[k])) wanted.emplace_back(*p, k);
  }
  std::sort(wanted.begin(), wanted.end());
  const Eigen::Index block = positions_at_once(map.grid());
  for (auto next = wanted.begin(); next != wanted.end();) {
    const Eigen::Index first = next->first, last = std::min(first + block, map.grid().positions());
    const auto end = std::lower_bound(next, wanted.end(), std::pair(last, std::size_t{0}));
    const ReachPositions best =
        reach_positions(map.grid(), map.cells(first, std::prev(end)->first + 1));
    for (; next != end; ++next) {
      const auto from = static_cast<std::size_t>(next->first - first);
      all.directions[next->second] = best.directions[from];
      all.branches[next->second] = best.branches[from];
      all.manipulability[next->second] = best.manipulability[from];
      all.margin[next->second] = best.margin[from];
    }
  }
  return all;
}

}  // namespace beeline::internal
