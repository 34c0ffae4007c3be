#pragma once

#include <vector>

#include <beeline/reach/internal/branches.h>
#include <beeline/reach/internal/hdf5_file.h>
#include <beeline/reach/internal/slabs.h>
#include <beeline/reach/reach_map.h>

namespace beeline::internal {

/// How a file stores the cells of a map: one chunk for each slab in each of its datasets. Their
/// axes are x, y, z and, where the grid has several, directions and rolls. A file of a cylindrical
/// grid has the branches of azimuth 0 (ReachBranches) instead of cells. Its axes are radius,
/// height, directions, rolls if they are solved, and the branches, of which the first max_branches
/// are stored.
class MapFormat {
 public:
  static constexpr Eigen::Index max_branches = 16;  // of a closed form, but in singular cells

  struct Dataset {
    const char* name;
    Hdf5Type type;
    bool of_branches = false;
  };
  /// A box in a dataset, where it begins and its size along each axis.
  struct Box {
    Hdf5Shape begin, size;
  };

  /// Throws Error as reach_cells() does.
  explicit MapFormat(const ReachMapHeader& header);

  const std::vector<Dataset>& datasets() const { return datasets_; }
  const FreeJoints& free() const { return free_; }
  const Slabs& slabs() const { return slabs_; }

  Hdf5Shape shape(const Dataset& dataset) const;
  Hdf5Shape chunk(const Dataset& dataset) const;
  Box box(const Dataset& dataset, Eigen::Index slab) const;

 private:
  /// Returns the shape of a dataset over positions with these counts; its other axes follow.
  Hdf5Shape of_positions(std::array<Eigen::Index, 3> counts, const Dataset& dataset) const;

  ReachGrid grid_;
  Slabs slabs_;
  FreeJoints free_;
  std::vector<Dataset> datasets_;
};

/// The datasets of a file, in the order of MapFormat::datasets().
using MapDatasets = std::vector<Hdf5Dataset>;

MapDatasets create_datasets(Hdf5File& file, const MapFormat& format);
/// Throws FileError for others.
MapDatasets open_datasets(const Hdf5File& file, const MapFormat& format);

/// All cells of a slab, of a grid that is not cylindrical.
void write_cells(MapDatasets& datasets, const MapFormat& format, Eigen::Index slab,
                 const ReachCells& cells);
ReachCells read_cells(const MapDatasets& datasets, const MapFormat& format, Eigen::Index slab);

/// The branches of a slab of a cylindrical grid. The count of a cell with more than max_branches
/// stays.
void write_branches(MapDatasets& datasets, const MapFormat& format, Eigen::Index slab,
                    const ReachBranches& branches);
ReachBranches read_branches(const MapDatasets& datasets, const MapFormat& format,
                            Eigen::Index slab);

}  // namespace beeline::internal
