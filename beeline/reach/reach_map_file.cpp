#include <memory>
#include <mutex>
#include <optional>

#include <beeline/reach/internal/cell_expansion.h>
#include <beeline/reach/internal/map_data.h>
#include <beeline/reach/internal/map_file.h>
#include <beeline/reach/internal/map_header.h>
#include <beeline/reach/internal/positions.h>

namespace beeline {
namespace {

using internal::CellExpansion;
using internal::MapFormat;

/// Reads the slabs of a file. The one read last is kept, decompressed. Threads take turns.
class SlabReader {
 public:
  SlabReader(const ReachMapHeader& header, std::shared_ptr<internal::Hdf5File> file)
      : header_(header),
        format_(header),
        file_(std::move(file)),
        datasets_(internal::open_datasets(*file_, format_)) {
    if (header.grid.cylindrical()) {
      expansion_.emplace(header.arm, header.grid, format_.free(), header.redundant_values);
    }
  }

  ReachCells read(Eigen::Index first, Eigen::Index last) {
    const std::lock_guard lock(reading_);
    const internal::Slabs& slabs = format_.slabs();
    const Eigen::Index slab = slabs.slab_of(first), begin = slabs.first(slab);
    const ReachGrid& grid = header_.grid;
    const Eigen::Index at_position = grid.directions() * grid.rolls();
    if (slab != slab_) load(slab);
    if (!expansion_) {
      return internal::part_of(cells_, (first - begin) * at_position, (last - begin) * at_position);
    }
    ReachCells cells;
    cells.resize(static_cast<std::size_t>((last - first) * at_position));
    expansion_->expand(branches_, begin / grid.azimuths(), first, last, first, cells);
    return cells;
  }

  std::vector<Eigen::Index> reached(Eigen::Index slab) {
    const std::lock_guard lock(reading_);
    if (slab != slab_) load(slab);
    return expansion_->reached(branches_, format_.slabs().first(slab) / header_.grid.azimuths());
  }

 private:
  void load(Eigen::Index slab) {
    slab_ = -1;  // if reading fails
    if (expansion_) {
      branches_ = internal::read_branches(datasets_, format_, slab);
    } else {
      cells_ = internal::read_cells(datasets_, format_, slab);
    }
    slab_ = slab;
  }

  ReachMapHeader header_;
  MapFormat format_;
  std::shared_ptr<internal::Hdf5File> file_;  // closed after its datasets
  internal::MapDatasets datasets_;
  std::optional<CellExpansion> expansion_;
  std::mutex reading_;
  Eigen::Index slab_ = -1;
  ReachCells cells_;
  internal::ReachBranches branches_;
};

}  // namespace

ReachMap::ReachMap(const std::string& path) {
  const auto file = std::make_shared<internal::Hdf5File>(path, internal::Hdf5File::Mode::read);
  const ReachMapHeader header = internal::read_header(*file, path);
  const auto reader = std::make_shared<SlabReader>(header, file);
  data_ = std::make_unique<Data>(Data{.path = path,
                                      .header = header,
                                      .slabs = internal::Slabs(header.grid),
                                      .there = internal::read_slabs(*file, header.grid),
                                      .read = [reader](Eigen::Index first, Eigen::Index last) {
                                        return reader->read(first, last);
                                      }});
  if (header.grid.cylindrical()) {
    data_->reached = [reader](Eigen::Index slab) { return reader->reached(slab); };
  }
}

}  // namespace beeline
