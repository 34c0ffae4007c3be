#pragma once

#include <string>
#include <vector>

#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/reach_map.h>

namespace beeline::internal {

/// The folder of the slabs of a map that are computed, a file each. Several processes, on several
/// machines, may compute into one folder.
class Parts {
 public:
  /// Makes the folder `map_path`.parts. Throws FileError if it cannot be made, or is of another
  /// map.
  Parts(const std::string& map_path, const ReachMapHeader& header);

  /// Whether the folder has that slab, whole.
  bool has(Eigen::Index slab) const;
  /// Computes a slab and writes its file.
  Ending compute(Eigen::Index slab, const ReachOptions& options) const;
  /// Joins slabs into one file.
  void join(const std::vector<Eigen::Index>& slabs, const std::string& path) const;
  /// Deletes the folder.
  void remove() const;

 private:
  std::string file(Eigen::Index slab) const;

  std::string folder_;
  ReachMapHeader header_;
  Slabs slabs_;
};

}  // namespace beeline::internal
