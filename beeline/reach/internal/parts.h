#pragma once

#include <functional>
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

/// Returns the units in which a map is computed, on one machine or several. A unit is one slab. By
/// sampling it is a group of slabs with 2^24 cells, because all samples are computed again for each
/// unit.
std::vector<SlabRange> units_of(const ReachMapHeader& header);

/// The folder of the slabs of a map that are computed, a file each. Several processes, on several
/// machines, may compute into one folder.
class Parts {
 public:
  /// Makes the folder `map_path`.parts. Throws FileError if it cannot be made, or is of another
  /// map.
  Parts(const std::string& map_path, const ReachMapHeader& header);
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  /// Whether the folder has these slabs completely.
  bool has(const SlabRange& unit) const;
  /// Computes slabs and writes their files. With one thread the files are complete when it returns.
  /// With several threads they are written during the next call; this call or finish() rethrows an
  /// error of the writing.
  Ending compute(const SlabRange& unit, const ReachOptions& options);
  /// Waits until the files of all computed slabs are written.
  void finish();
  /// Joins the slabs of units, whose files are there, into one file.
  void join(const std::vector<SlabRange>& units, const std::string& path) const;
  /// Deletes the files that this class makes, and the folder if nothing else is in it. A link to a
  /// folder stays.
  void remove() const;

 private:
  std::string file(Eigen::Index slab) const;
  bool has_slab(Eigen::Index slab) const;
  void write(Eigen::Index slab, const auto& computed) const;
  void write_files(const SlabRange& unit, const ReachCells& cells) const;
  void write_with(int threads, std::function<void()> write);

  std::string folder_;
  ReachMapHeader header_;
  Slabs slabs_;
  std::future<void> writing_;  // its destructor waits
};

}  // namespace beeline::internal
