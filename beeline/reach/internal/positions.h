#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include <beeline/reach/surface.h>

namespace beeline::internal {

/// Throws Error unless the grid has the positions from `first` to `last`, exclusive.
void check_positions(const ReachGrid& grid, Eigen::Index first, Eigen::Index last);

/// Returns the number of positions that are processed together: about a million cells.
inline Eigen::Index positions_at_once(const ReachGrid& grid) {
  constexpr Eigen::Index cells = Eigen::Index{1} << 20;
  return std::max<Eigen::Index>(1, cells / (grid.directions() * grid.rolls()));
}

/// The cells from `first` to `last`, exclusive.
ReachCells part_of(const ReachCells& cells, Eigen::Index first, Eigen::Index last);

/// Throws FileError unless the map has all its cells.
void check_complete(const ReachMap& map);

/// Calls `use` for consecutive blocks of the centres of cells along x, y and z
/// (ReachGrid::cartesian_axes()), z the fastest.
void for_each_block(const std::array<ReachAxis, 3>& axes,
                    const std::function<void(const std::vector<Vector3>& centres)>& use);

/// The best of the positions of a map that contain these points; those outside are not reached.
/// Reads each slab of the map once. Throws FileError for an incomplete map.
ReachPositions positions_at(const ReachMap& map, const std::vector<Vector3>& points);

/// slice_of() with the centres of these cells.
ReachSlice slice_at(const ReachMap& map, std::array<ReachAxis, 3> axes, int normal, double at,
                    ReachMeasure measure);

}  // namespace beeline::internal
