#pragma once

#include <beeline/reach/grid.h>

namespace beeline::internal {

/// Throws Error unless the grid has the positions from `first` to `last`, exclusive.
void check_positions(const ReachGrid& grid, Eigen::Index first, Eigen::Index last);

}  // namespace beeline::internal
