#pragma once

#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// One of `count` shares of a map's slabs: those with the numbers number - 1, number - 1 + count,
/// and so on; by sampling, as many slabs together as have 2^24 cells.
struct ReachShard {
  int number = 1, count = 1;  ///< number from 1 to count
};

struct ReachMapOptions {
  ReachOptions reach = {};
  ReachShard shard = {};
};

/// Computes a map, or a shard of it, into a file. Each slab is written whole into the folder
/// `path`.parts, where a call that follows one that was ended or killed finds it; in the end they
/// are joined and deleted. The datasets do not depend on threads, shards or interruptions. The
/// memory needed is that of two slabs, by sampling of 2^25 cells. Throws Error as reach_cells()
/// does and for a shard that does not exist; FileError for what cannot be written and for a folder
/// with slabs of another map.
Ending compute_reach_map(const Arm& arm, const ReachGrid& grid, const std::string& path,
                         const ReachMapOptions& options = {});

/// Joins files that hold parts of one map, such as shards, into one file. The cells are copied as
/// they are stored. Throws FileError for parts of different maps, and where slabs are missing from
/// all of them unless `incomplete`.
void merge_reach_maps(const std::vector<std::string>& parts, const std::string& path,
                      bool incomplete = false);

}  // namespace beeline
