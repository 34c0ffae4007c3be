#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/reach/internal/positions.h>
#include <beeline/reach/surface.h>

namespace beeline {
namespace {

/// The kind of directions whose fraction is compared: tool directions with and without rolls are
/// one kind.
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
  if ((first.header().samples > 0) != (second.header().samples > 0)) {
    throw Error(
        "one map is by sampling, anywhere in a cell, the other by inverse kinematics, at its "
        "centre: they cannot be compared");
  }
  const auto a = first.grid().cartesian_axes(), b = second.grid().cartesian_axes();
  const bool planar = first.arm().planar() && second.arm().planar();
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
    if (planar && k == 2) axes[k] = finer;  // one layer, however thick its cells
    points *= static_cast<double>(axes[k].cells);
  }
  constexpr double most = 1e8;
  if (!(points <= most)) {
    throw Error("the maps would be compared at " + number(points) +
                " points, at most 1e8 are possible: compare coarser ones");
  }
  return axes;
}

/// Adds a point that either map reaches.
void add(ReachSide& side, const ReachPositions& own, const ReachPositions& other, std::size_t p) {
  const bool reached = own.branches[p] > 0, also = other.branches[p] > 0;
  side.directions += static_cast<double>(own.directions[p]);
  side.volume_more_directions += own.directions[p] > other.directions[p];
  side.volume += reached;
  side.volume_only_here += reached && !also;
  if (!reached || !also) return;
  side.manipulability += static_cast<double>(own.manipulability[p]);
  side.margin += static_cast<double>(own.margin[p]);
}

}  // namespace

ReachComparison compare_reach(const ReachMap& first, const ReachMap& second) {
  const std::array<ReachAxis, 3> axes = common_axes(first, second);
  const double step = axes[0].step;
  ReachComparison comparison{.sides = {}, .step = step};
  double either = 0;
  internal::for_each_block(axes, [&](const std::vector<Vector3>& points) {
    const std::array<ReachPositions, 2> best{internal::positions_at(first, points),
                                             internal::positions_at(second, points)};
    for (std::size_t p = 0; p < points.size(); ++p) {
      const std::array<bool, 2> reached{best[0].branches[p] > 0, best[1].branches[p] > 0};
      if (!reached[0] && !reached[1]) continue;
      ++either;
      comparison.both += reached[0] && reached[1];
      for (std::size_t k = 0; k < 2; ++k) add(comparison.sides[k], best[k], best[1 - k], p);
    }
  });
  const bool planar = first.arm().planar() && second.arm().planar();
  const double cell = planar ? step * step : step * step * step;
  for (ReachSide& side : comparison.sides) {  // counts become volumes, sums means
    side.volume *= cell;
    side.volume_only_here *= cell;
    side.volume_more_directions *= cell;
    side.directions = either > 0 ? side.directions / either : 0;
    side.manipulability /= comparison.both;
    side.margin /= comparison.both;
  }
  comparison.both *= cell;
  return comparison;
}

std::array<ReachSlice, 2> slices_of(const ReachMap& first, const ReachMap& second, int normal,
                                    double at, ReachMeasure measure) {
  const std::array<ReachAxis, 3> axes = common_axes(first, second);
  return {internal::slice_at(first, axes, normal, at, measure),
          internal::slice_at(second, axes, normal, at, measure)};
}

}  // namespace beeline
