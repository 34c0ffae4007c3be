#pragma once

#include <beeline/reach/reach.h>

namespace beeline::internal {

/// Computes the cells of the positions from `first` to `last` (exclusive) from the first `samples`
/// configurations of a sequence that fills the joint ranges evenly: the additive recurrence of
/// M. Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018), of the plastic
/// number's generalisation to the number of joints. Each sample is in the cell that
/// ReachGrid::cell_of() names. Throws Error for a prismatic joint without position limits, for a
/// cylindrical grid, and for one with a single orientation.
ReachCells sampled_cells(const Arm& arm, const ReachGrid& grid, Eigen::Index first,
                         Eigen::Index last, const ReachOptions& options);

}  // namespace beeline::internal
