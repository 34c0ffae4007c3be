#include <algorithm>

#include <beeline/reach/internal/map_file.h>
#include <beeline/reach/internal/map_header.h>
#include <beeline/reach/internal/positions.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

struct ReachMap::File {
  explicit File(const std::string& at)
      : path(at),
        file(at, internal::Hdf5File::Mode::read),
        header(internal::read_header(file, at)),
        slabs(header.grid),
        there(internal::read_slabs(file, header.grid)),
        datasets(internal::open_datasets(file, header.grid)) {}

  std::string path;
  internal::Hdf5File file;
  ReachMapHeader header;
  internal::Slabs slabs;
  std::vector<bool> there;
  internal::MapDatasets datasets;
};

ReachMap::ReachMap(const std::string& path) : file_(std::make_unique<File>(path)) {}
ReachMap::~ReachMap() = default;
ReachMap::ReachMap(ReachMap&&) noexcept = default;
ReachMap& ReachMap::operator=(ReachMap&&) noexcept = default;

const std::string& ReachMap::path() const { return file_->path; }
const ReachMapHeader& ReachMap::header() const { return file_->header; }
const std::vector<bool>& ReachMap::slabs() const { return file_->there; }

bool ReachMap::complete() const {
  return std::all_of(slabs().begin(), slabs().end(), [](bool there) { return there; });
}

ReachMap::Totals ReachMap::totals() const {
  Totals totals;
  const Eigen::Index at_position = grid().directions() * grid().rolls();
  for (Eigen::Index s = 0; s < file_->slabs.count(); ++s) {
    if (!slabs()[static_cast<std::size_t>(s)]) continue;
    const ReachCells slab = cells(file_->slabs.first(s), file_->slabs.last(s));
    for (auto at = slab.branches.begin(); at != slab.branches.end(); at += at_position) {
      const auto reached = at_position - std::count(at, at + at_position, 0);
      totals.cells += at_position;
      totals.reached += reached;
      ++totals.positions;
      totals.reached_positions += reached > 0;
    }
  }
  return totals;
}

ReachCells ReachMap::cells(Eigen::Index first, Eigen::Index last) const {
  internal::check_positions(grid(), first, last);
  const Eigen::Index at_position = grid().directions() * grid().rolls();
  ReachCells cells;
  cells.resize(static_cast<std::size_t>((last - first) * at_position));
  ReachCells slab;
  for (Eigen::Index p = first; p < last;) {
    const Eigen::Index s = file_->slabs.slab_of(p);
    if (!slabs()[static_cast<std::size_t>(s)]) {
      throw FileError(path(), 0, "holds part of a map, without position " + std::to_string(p));
    }
    // The whole slab: it is one chunk, which is decompressed in any case.
    const Eigen::Index begin = file_->slabs.first(s), end = std::min(file_->slabs.last(s), last);
    slab.resize(static_cast<std::size_t>((file_->slabs.last(s) - begin) * at_position));
    const auto [box_begin, size] = internal::box_of(grid(), file_->slabs, s);
    file_->datasets.branches.read(box_begin, size, slab.branches.data());
    file_->datasets.manipulability.read(box_begin, size, slab.manipulability.data());
    file_->datasets.margin.read(box_begin, size, slab.margin.data());
    const auto copy = [&](const auto& from, auto& to) {
      std::copy(from.begin() + (p - begin) * at_position,
                from.begin() + (end - begin) * at_position, to.begin() + (p - first) * at_position);
    };
    copy(slab.branches, cells.branches);
    copy(slab.manipulability, cells.manipulability);
    copy(slab.margin, cells.margin);
    p = end;
  }
  return cells;
}

}  // namespace beeline
