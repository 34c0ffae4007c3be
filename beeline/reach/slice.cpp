#include <limits>

#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/slice.h>

namespace beeline {
namespace {

float value_of(const ReachPositions& best, std::size_t k, ReachMeasure measure) {
  if (best.branches[k] == 0) return std::numeric_limits<float>::quiet_NaN();
  switch (measure) {
    case ReachMeasure::directions:
      return best.directions[k];
    case ReachMeasure::branches:
      return best.branches[k];
    case ReachMeasure::manipulability:
      return best.manipulability[k];
    case ReachMeasure::margin:
      break;
  }
  return best.margin[k];
}

}  // namespace

std::string name(ReachMeasure measure) {
  switch (measure) {
    case ReachMeasure::directions:
      return "directions";
    case ReachMeasure::branches:
      return "branches";
    case ReachMeasure::manipulability:
      return "manipulability";
    case ReachMeasure::margin:
      break;
  }
  return "margin";
}

ReachSlice slice_of(const ReachMap& map, int normal, double at, ReachMeasure measure) {
  const ReachGrid& grid = map.grid();
  if (normal < 0 || normal > 2) throw Error("the axis of a slice is 0, 1 or 2");
  const ReachAxis& axis = grid.axes()[normal];
  const std::optional<Eigen::Index> index = axis.cell_of(at);
  if (!index) {
    throw Error(std::string("the slice at ") + "xyz"[normal] + " = " + number(at) +
                " is outside the map, which has " + number(axis.lower) + " to " +
                number(axis.upper()));
  }
  if (!map.complete()) throw Error(map.path() + " is incomplete: merge its parts first");
  ReachSlice slice{.arm = map.arm(),
                   .measure = measure,
                   .normal = normal,
                   .at = axis.centre(*index),
                   .axes = {normal == 0 ? 1 : 0, normal == 2 ? 1 : 2}};
  for (int k = 0; k < 2; ++k) slice.grid[k] = grid.axes()[slice.axes[k]];
  slice.values.resize(slice.grid[0].cells, slice.grid[1].cells);
  const internal::Slabs slabs(grid);
  for (Eigen::Index s = 0; s < slabs.count(); ++s) {
    const Eigen::Index begin = slabs.begin(s)[normal], size = slabs.size(s)[normal];
    if (*index < begin || *index >= begin + size) continue;
    const Eigen::Index first = slabs.first(s), last = slabs.last(s);
    const ReachPositions best = reach_positions(grid, map.cells(first, last));
    for (Eigen::Index p = first; p < last; ++p) {
      const auto at_p = grid.indices(p);
      if (at_p[normal] != *index) continue;
      slice.values(at_p[slice.axes[0]], at_p[slice.axes[1]]) =
          value_of(best, static_cast<std::size_t>(p - first), measure);
    }
  }
  return slice;
}

}  // namespace beeline
