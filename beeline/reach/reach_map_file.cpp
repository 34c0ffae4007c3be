#include <memory>
#include <mutex>
#include <optional>

#include <beeline/batch/internal/copies.h>
#include <beeline/batch/internal/parallel.h>
#include <beeline/reach/internal/cell_expansion.h>
#include <beeline/reach/internal/map_data.h>
#include <beeline/reach/internal/map_file.h>
#include <beeline/reach/internal/map_header.h>
#include <beeline/reach/internal/positions.h>

namespace beeline {
namespace {

using internal::CellExpansion;
using internal::MapFormat;

/// Reads the slabs of a file. The last slab read is kept decompressed, as are the slabs that other
/// threads read meanwhile. Threads take turns in reading the file; they compute in parallel.
class SlabReader {
 public:
  SlabReader(const ReachMapHeader& header, std::shared_ptr<internal::Hdf5File> file, int threads)
      : header_(header),
        threads_(threads),
        format_(header),
        file_(std::move(file)),
        datasets_(internal::open_datasets(*file_, format_)) {
    if (!header.grid.cylindrical()) return;
    expansions_.emplace(
        CellExpansion(header.arm, header.grid, format_.free(), header.redundant_values));
  }

  ReachCells read(Eigen::Index first, Eigen::Index last) {
    const ReachGrid& grid = header_.grid;
    const std::shared_ptr<const Slab> slab = slab_at(format_.slabs().slab_of(first));
    const Eigen::Index at_position = grid.directions() * grid.rolls();
    if (!expansions_) {
      return internal::part_of(slab->cells, (first - slab->begin) * at_position,
                               (last - slab->begin) * at_position);
    }
    ReachCells cells;
    cells.resize(static_cast<std::size_t>((last - first) * at_position));
    constexpr Eigen::Index block = 8;
    internal::in_parallel(last - first, block, threads_, [&](Eigen::Index a, Eigen::Index b) {
      expansions_->borrow()->expand(slab->branches, slab->begin / grid.azimuths(), first + a,
                                    first + b, first, cells);
    });
    return cells;
  }

  std::vector<Eigen::Index> reached(Eigen::Index number) {
    const std::shared_ptr<const Slab> slab = slab_at(number);
    const Eigen::Index azimuths = header_.grid.azimuths();
    const Eigen::Index positions = format_.slabs().last(number) - slab->begin;
    std::vector<Eigen::Index> counts(static_cast<std::size_t>(positions), 0);
    internal::in_parallel(positions / azimuths, 1, threads_, [&](Eigen::Index a, Eigen::Index b) {
      expansions_->borrow()->count_reached(slab->branches, slab->begin / azimuths, a, b, counts);
    });
    return counts;
  }

 private:
  struct Slab {
    Eigen::Index number, begin;  // the first position
    ReachCells cells = {};
    internal::ReachBranches branches = {};  // of a cylindrical map, instead of cells
  };

  std::shared_ptr<const Slab> slab_at(Eigen::Index number) {
    const std::lock_guard lock(reading_);
    if (latest_ && latest_->number == number) return latest_;
    latest_.reset();  // so that one thread needs the memory of one slab
    Slab slab{.number = number, .begin = format_.slabs().first(number)};
    if (expansions_) {
      slab.branches = internal::read_branches(datasets_, format_, number);
    } else {
      slab.cells = internal::read_cells(datasets_, format_, number);
    }
    latest_ = std::make_shared<const Slab>(std::move(slab));
    return latest_;
  }

  ReachMapHeader header_;
  int threads_;
  MapFormat format_;
  std::shared_ptr<internal::Hdf5File> file_;  // closed after its datasets
  internal::MapDatasets datasets_;
  std::optional<internal::Copies<CellExpansion>> expansions_;
  std::mutex reading_;
  std::shared_ptr<const Slab> latest_;
};

}  // namespace

ReachMap::ReachMap(const std::string& path, int threads) {
  const auto file = std::make_shared<internal::Hdf5File>(path, internal::Hdf5File::Mode::read);
  const ReachMapHeader header = internal::read_header(*file, path);
  const auto reader = std::make_shared<SlabReader>(header, file, threads);
  data_ = std::make_unique<Data>(Data{.path = path,
                                      .header = header,
                                      .slabs = internal::Slabs(header.grid),
                                      .is_filled = internal::read_slabs(*file, header.grid),
                                      .read = [reader](Eigen::Index first, Eigen::Index last) {
                                        return reader->read(first, last);
                                      }});
  if (header.grid.cylindrical()) {
    data_->reached = [reader](Eigen::Index slab) { return reader->reached(slab); };
  }
}

}  // namespace beeline
