#pragma once

#include <functional>

#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// The source of a map's cells. `read` returns the cells of the positions from `first` to `last`
/// (exclusive) of one slab.
struct ReachMap::Data {
  std::string path;
  ReachMapHeader header;
  internal::Slabs slabs;
  std::vector<bool> is_filled;
  std::function<ReachCells(Eigen::Index first, Eigen::Index last)> read;
  /// Returns the number of reached cells of each position of a slab; empty: counted from the cells
  /// of `read`.
  std::function<std::vector<Eigen::Index>(Eigen::Index slab)> reached = {};
};

}  // namespace beeline
