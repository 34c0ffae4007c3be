#pragma once

#include <functional>

#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// Where a map has its cells, which `read` returns: of the positions from `first` to `last`
/// (exclusive) of one slab.
struct ReachMap::Data {
  std::string path;
  ReachMapHeader header;
  internal::Slabs slabs;
  std::vector<bool> there;
  std::function<ReachCells(Eigen::Index first, Eigen::Index last)> read;
  /// The number of reached cells of each position of a slab; empty: as `read` returns them.
  std::function<std::vector<Eigen::Index>(Eigen::Index slab)> reached = {};
};

}  // namespace beeline
