#pragma once

#include <functional>

#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// Where a map has its cells, which `read` returns by slabs.
struct ReachMap::Data {
  std::string path;
  ReachMapHeader header;
  internal::Slabs slabs;
  std::vector<bool> there;
  std::function<ReachCells(Eigen::Index slab)> read;
};

}  // namespace beeline
