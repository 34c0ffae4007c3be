#include <cmath>
#include <limits>

#include <beeline/internal/enum_names.h>
#include <beeline/reach/internal/positions.h>
#include <beeline/reach/surface.h>

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
  constexpr internal::EnumNames<ReachMeasure> names("measure");
  return names.of(measure);
}

ReachSlice slice_of(const ReachMap& map, int normal, double at, ReachMeasure measure) {
  return internal::slice_at(map, map.grid().cartesian_axes(), normal, at, measure);
}

ReachSlice internal::slice_at(const ReachMap& map, std::array<ReachAxis, 3> axes, int normal,
                              double at, ReachMeasure measure) {
  if (normal < 0 || normal > 2) throw Error("the axis of a slice is 0, 1 or 2");
  const std::optional<Eigen::Index> index = axes[normal].cell_of(at);
  if (!index) {
    throw Error::of("at", std::string("the slice at ") + "xyz"[normal] + " = " + number(at) +
                              " is outside the map, which has " + number(axes[normal].lower) +
                              " to " + number(axes[normal].upper()));
  }
  axes[normal].lower += static_cast<double>(*index) * axes[normal].step;
  axes[normal].cells = 1;
  ReachSlice slice{.arm = map.arm(),
                   .measure = measure,
                   .normal = normal,
                   .at = axes[normal].centre(0),
                   .axes = {normal == 0 ? 1 : 0, normal == 2 ? 1 : 2}};
  if (std::abs(slice.at) < 1e-9 * axes[normal].step) slice.at = 0;
  for (int k = 0; k < 2; ++k) slice.grid[k] = axes[slice.axes[k]];
  slice.values.resize(slice.grid[0].cells, slice.grid[1].cells);
  Eigen::Index next = 0;  // the second axis of the slice is the faster one
  for_each_block(axes, [&](const std::vector<Vector3>& centres) {
    const ReachPositions best = positions_at(map, centres);
    for (std::size_t k = 0; k < centres.size(); ++k, ++next) {
      slice.values(next / slice.values.cols(), next % slice.values.cols()) =
          value_of(best, k, measure);
    }
  });
  return slice;
}

}  // namespace beeline
