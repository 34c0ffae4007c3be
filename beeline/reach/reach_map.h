#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/reach/reach.h>

namespace beeline {

/// The subject of a map: the arm, the grid and the method.
struct ReachMapHeader {
  Arm arm;
  ReachGrid grid;
  int redundant_values = 16;  ///< see ReachOptions
  std::int64_t samples = 0;   ///< configurations of a map by sampling; 0: by inverse kinematics
  std::optional<ReachScene> scene = std::nullopt;  ///< in which solutions are free; none: all count
};

/// A reach map, in memory or in an HDF5 file, which any program that reads HDF5 reads too
/// (docs/howto/reach.md lists its attributes and datasets). Cells are read from a file when they
/// are asked for. A file may hold part of a map: a shard, or one whose computation was ended.
/// Threads may read one map.
class ReachMap {
 public:
  /// Opens a file. `threads` threads expand the cells of a map by azimuths; 0: one for each core.
  /// Throws FileError for a file that cannot be read or is no reach map.
  explicit ReachMap(const std::string& path, int threads = 0);
  /// A map in memory. Throws Error for cells that were not computed to the end or do not cover all
  /// positions of the grid.
  ReachMap(ReachMapHeader header, ReachCells cells);
  ~ReachMap();
  ReachMap(ReachMap&&) noexcept;
  ReachMap& operator=(ReachMap&&) noexcept;

  const std::string& path() const;  ///< path of the file; empty for a map in memory
  const ReachMapHeader& header() const;
  const Arm& arm() const { return header().arm; }
  const ReachGrid& grid() const { return header().grid; }

  /// Whether each slab is available. A map is stored in slabs, which are ranges of positions.
  const std::vector<bool>& slabs() const;
  bool complete() const;
  /// Whether the slab of the position is available. Throws Error for a position outside the grid.
  bool has(Eigen::Index position) const;
  /// The end, exclusive, of the positions that are best read together with this one: within one
  /// slab, about a million cells.
  Eigen::Index block_end(Eigen::Index position) const;

  /// Counts over all available cells.
  struct Totals {
    std::int64_t cells = 0;      ///< number of cells in this map, which may be part of the grid
    std::int64_t reached = 0;    ///< number of these cells that are reached
    std::int64_t positions = 0;  ///< number of available positions
    /// Number of these positions that are reached in some orientation.
    std::int64_t reached_positions = 0;
    double volume = 0;  ///< volume of the reached positions, m^3; of planar arms their area, m^2
  };
  Totals totals() const;

  /// Reads the cells of the positions from `first` to `last`, exclusive. Throws Error for positions
  /// outside the grid, FileError for ones that are not in the file.
  ReachCells cells(Eigen::Index first, Eigen::Index last) const;

 private:
  std::vector<Eigen::Index> reached_in(Eigen::Index slab) const;  // cells of each position

  struct Data;
  std::unique_ptr<Data> data_;
};

/// One of `count` shares of a map, one for each process. It has the slabs with the numbers number -
/// 1, number - 1 + count, and so on; by sampling, each number means a group of slabs with 2^24
/// cells.
struct ReachShard {
  int number = 1;  ///< number of this share, from 1 to count
  int count = 1;   ///< number of shares
};

struct ReachMapOptions {
  ReachOptions reach = {};
  ReachShard shard = {};
};

/// Computes a map, or a shard of it, into a file. Each slab is written whole into the folder
/// `path`.parts. A call after an ended or killed one reuses these slabs. The last step joins and
/// deletes them. The datasets do not depend on threads, shards or interruptions. Needs the memory
/// of two slabs, by sampling the memory of 2^25 cells. Throws Error as reach_cells() does, for
/// `blocked_by` without `scene` and for a shard that does not exist. Throws FileError for a file
/// that cannot be written and for a folder with slabs of another map.
Ending compute_reach_map(const Arm& arm, const ReachGrid& grid, const std::string& path,
                         const ReachMapOptions& options = {});

/// The computation of a map by several processes, on one machine or on several that share the
/// folder `path`.parts: the map is divided into units, and each process computes some of them, by
/// their numbers.
class ReachMapUnits {
 public:
  /// Makes the folder. Throws as compute_reach_map().
  ReachMapUnits(const Arm& arm, const ReachGrid& grid, const std::string& path,
                const ReachOptions& options = {});
  ~ReachMapUnits();

  std::vector<Eigen::Index> missing() const;  ///< the units whose slabs are not in the folder
  /// Computes units until `next` returns none. If the budget ends the computation, `next` is still
  /// called until it returns none, but no unit is computed.
  Ending compute(const std::function<std::optional<Eigen::Index>()>& next);
  /// Joins the slabs of all units, which are in the folder, into the file and deletes the folder.
  void join();

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

/// Joins files that hold parts of one map, such as shards, into one file. The cells are copied as
/// they are stored. Throws FileError for parts of different maps, and, unless `incomplete`, if a
/// slab is missing from all of them.
void merge_reach_maps(const std::vector<std::string>& parts, const std::string& path,
                      bool incomplete = false);

}  // namespace beeline
