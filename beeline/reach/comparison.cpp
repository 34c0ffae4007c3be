#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/reach/comparison.h>
#include <beeline/reach/internal/positions.h>

namespace beeline {
namespace {

/// What the fraction of directions is of: tool directions with or without rolls are the same.
ReachOrientations kind_of(const ReachGrid& grid) {
  const ReachOrientations orientations = grid.orientations();
  return orientations == ReachOrientations::rolls ? ReachOrientations::directions : orientations;
}

/// Cells that cover both maps.
std::array<ReachAxis, 3> common_axes(const ReachMap& first, const ReachMap& second) {
  if (kind_of(first.grid()) != kind_of(second.grid())) {
    throw Error("the maps have orientations of two kinds, " + name(first.grid().orientations()) +
                " and " + name(second.grid().orientations()) + ", which cannot be compared");
  }
  const auto a = first.grid().cartesian_axes(), b = second.grid().cartesian_axes();
  std::array<ReachAxis, 3> axes;
  double points = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double step = std::min(a[k].step, b[k].step);
    const ReachAxis& finer = a[k].step <= b[k].step ? a[k] : b[k];
    // Cells of the finer map, and as many more on both sides as the other needs.
    const double below =
        std::max(0.0, std::ceil((finer.lower - std::min(a[k].lower, b[k].lower)) / step - 1e-9));
    const double above = std::max(
        0.0, std::ceil((std::max(a[k].upper(), b[k].upper()) - finer.upper()) / step - 1e-9));
    axes[k] = {finer.cells + static_cast<Eigen::Index>(below + above), finer.lower - below * step,
               step};
    points *= static_cast<double>(axes[k].cells);
  }
  constexpr double most = 1e8;
  if (!(points <= most)) {
    throw Error("the maps would be compared at " + number(points) +
                " points, at most 1e8 are possible: compare coarser ones");
  }
  return axes;
}

}  // namespace

ReachComparison compare_reach(const ReachMap& first, const ReachMap& second) {
  const std::array<ReachAxis, 3> axes = common_axes(first, second);
  const std::vector<Vector3> points = internal::centres_of(axes);
  const std::array<ReachPositions, 2> best{internal::positions_at(first, points),
                                           internal::positions_at(second, points)};
  const double step = axes[0].step;
  const bool planar = first.arm().planar() && second.arm().planar();
  const double cell = planar ? step * step : step * step * step;
  ReachComparison comparison{.sides = {}, .step = step};
  double either = 0, both = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const std::array<bool, 2> reached{best[0].branches[p] > 0, best[1].branches[p] > 0};
    if (!reached[0] && !reached[1]) continue;
    ++either;
    both += reached[0] && reached[1];
    for (std::size_t k = 0; k < 2; ++k) {
      ReachSide& side = comparison.sides[k];
      const ReachPositions& other = best[1 - k];
      side.directions += static_cast<double>(best[k].directions[p]);
      side.better += best[k].directions[p] > other.directions[p];
      side.volume += reached[k];
      side.alone += reached[k] && !reached[1 - k];
      if (!reached[0] || !reached[1]) continue;
      side.manipulability += static_cast<double>(best[k].manipulability[p]);
      side.margin += static_cast<double>(best[k].margin[p]);
    }
  }
  comparison.both = both * cell;
  for (ReachSide& side : comparison.sides) {  // counts become volumes, sums means
    side.volume *= cell;
    side.alone *= cell;
    side.better *= cell;
    side.directions = either > 0 ? side.directions / either : 0;
    side.manipulability /= both;
    side.margin /= both;
  }
  return comparison;
}

std::array<ReachSlice, 2> slices_of(const ReachMap& first, const ReachMap& second, int normal,
                                    double at, ReachMeasure measure) {
  const std::array<ReachAxis, 3> axes = common_axes(first, second);
  return {internal::slice_at(first, axes, normal, at, measure),
          internal::slice_at(second, axes, normal, at, measure)};
}

}  // namespace beeline
