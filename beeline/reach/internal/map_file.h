#pragma once

#include <string>
#include <vector>

#include <beeline/reach/internal/map_format.h>

namespace beeline::internal {

/// Returns which slabs are in the file.
std::vector<bool> read_slabs(const Hdf5File& file, const ReachGrid& grid);

/// Writes a new file of a map, slab by slab, beside its path; commit() renames it.
class MapWriter {
 public:
  /// Throws FileError for a path that cannot be written: a folder, a device.
  MapWriter(const std::string& path, const ReachMapHeader& header);
  ~MapWriter();  ///< deletes what was not committed
  MapWriter(const MapWriter&) = delete;
  MapWriter& operator=(const MapWriter&) = delete;

  /// Writes all cells of a slab, or the branches of one of a cylindrical grid.
  void write(Eigen::Index slab, const ReachCells& cells);
  void write(Eigen::Index slab, const ReachBranches& branches);
  /// Copies the slabs of another file of the same map as they are stored.
  void copy_slabs(const std::string& path);
  /// The slabs written.
  const std::vector<bool>& slabs() const { return written_; }
  void commit();

 private:
  std::string path_, temporary_;
  ReachMapHeader header_;
  MapFormat format_;
  std::vector<bool> written_;
  Hdf5File file_;
  MapDatasets datasets_;
};

/// Throws FileError for a path at which no file can be made or replaced: a folder, a device, a
/// folder that is missing.
void check_map_path(const std::string& path);

}  // namespace beeline::internal
