#pragma once

#include <memory>
#include <string>
#include <vector>

#include <beeline/reach/internal/hdf5_file.h>
#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/reach_map.h>

namespace beeline::internal {

/// The datasets of a map, one value for each cell.
struct MapDatasets {
  Hdf5Dataset branches, manipulability, margin;
};

/// Opens them in a file of a map with that grid. Throws FileError for others.
MapDatasets open_datasets(const Hdf5File& file, const ReachGrid& grid);

/// Reads which slabs are in the file.
std::vector<bool> read_slabs(const Hdf5File& file, const ReachGrid& grid);

/// The box of a slab in the datasets, whose axes are x, y, z and, where the grid has several,
/// directions and rolls.
struct SlabBox {
  Hdf5Shape begin, size;
};
SlabBox box_of(const ReachGrid& grid, const Slabs& slabs, Eigen::Index slab);

/// Writes a new file of a map, slab by slab, beside its path; commit() renames it.
class MapWriter {
 public:
  /// Throws FileError for a path that cannot be written: a folder, a device.
  MapWriter(const std::string& path, const ReachMapHeader& header);
  ~MapWriter();  ///< deletes what was not committed
  MapWriter(const MapWriter&) = delete;
  MapWriter& operator=(const MapWriter&) = delete;

  /// Writes all cells of a slab.
  void write(Eigen::Index slab, const ReachCells& cells);
  /// Copies the slabs of another file of the same map as they are stored.
  void copy_slabs(const std::string& path);
  /// The slabs written.
  const std::vector<bool>& slabs() const { return written_; }
  void commit();

 private:
  std::string path_, temporary_;
  ReachMapHeader header_;
  Slabs slabs_;
  std::vector<bool> written_;
  Hdf5File file_;
  std::unique_ptr<MapDatasets> datasets_;
};

/// Throws FileError for a path at which no file can be made or replaced: a folder, a device, a
/// folder that is missing.
void check_map_path(const std::string& path);

}  // namespace beeline::internal
