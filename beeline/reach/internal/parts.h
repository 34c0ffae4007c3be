#pragma once

#include <string>
#include <vector>

#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/reach_map.h>

namespace beeline::internal {

/// Consecutive slabs that are computed together, one after the other.
struct SlabRange {
  Eigen::Index first = 0, last = 0;  ///< exclusive
};

/// The units in which a map is computed, on one machine or several: each slab; by sampling, whose
/// samples are computed anew for each unit, as many slabs as have 2^24 cells.
std::vector<SlabRange> units_of(const ReachMapHeader& header);

/// The folder of the slabs of a map that are computed, a file each. Several processes, on several
/// machines, may compute into one folder.
class Parts {
 public:
  /// Makes the folder `map_path`.parts. Throws FileError if it cannot be made, or is of another
  /// map.
  Parts(const std::string& map_path, const ReachMapHeader& header);

  /// Whether the folder has those slabs, whole.
  bool has(const SlabRange& unit) const;
  /// Computes slabs and writes their files.
  Ending compute(const SlabRange& unit, const ReachOptions& options) const;
  /// Joins the slabs of units into one file.
  void join(const std::vector<SlabRange>& units, const std::string& path) const;
  /// Deletes the folder.
  void remove() const;

 private:
  std::string file(Eigen::Index slab) const;
  bool has_slab(Eigen::Index slab) const;
  void write(Eigen::Index slab, const auto& computed) const;

  std::string folder_;
  ReachMapHeader header_;
  Slabs slabs_;
};

}  // namespace beeline::internal
