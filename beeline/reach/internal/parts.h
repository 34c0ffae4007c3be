#pragma once

#include <future>
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
  /// Computes slabs and writes their files: with one thread at once, with several while the next
  /// call computes. Throws what was thrown while the last unit was written.
  Ending compute(const SlabRange& unit, const ReachOptions& options);
  /// Waits until the files of all units are written. Throws as compute() does.
  void finish();
  /// Joins the slabs of units into one file.
  void join(const std::vector<SlabRange>& units, const std::string& path) const;
  /// Deletes the files of the slabs, and the folder if nothing else is in it. A link to a folder
  /// stays.
  void remove() const;

 private:
  std::string file(Eigen::Index slab) const;
  bool has_slab(Eigen::Index slab) const;
  void write(Eigen::Index slab, const auto& computed) const;
  void write_files(const SlabRange& unit, const ReachCells& cells) const;
  void in_background(const ReachOptions& options, std::function<void()> write);

  std::string folder_;
  ReachMapHeader header_;
  Slabs slabs_;
  std::future<void> writing_;  // its destructor waits
};

}  // namespace beeline::internal
