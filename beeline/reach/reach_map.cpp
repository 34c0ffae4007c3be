#include <algorithm>

#include <beeline/reach/internal/map_data.h>
#include <beeline/reach/internal/positions.h>

namespace beeline {
namespace {

/// The cells from `first` to `last`, exclusive.
ReachCells part_of(const ReachCells& cells, Eigen::Index first, Eigen::Index last) {
  const auto part = [first, last](const auto& values) {
    return std::decay_t<decltype(values)>(values.begin() + first, values.begin() + last);
  };
  return {part(cells.branches), part(cells.manipulability), part(cells.margin)};
}

}  // namespace

ReachMap::ReachMap(ReachMapHeader header, ReachCells cells) {
  if (cells.ending != Ending::complete) throw Error("the cells were not computed to the end");
  const auto count = static_cast<std::size_t>(header.grid.cells());
  if (cells.branches.size() != count || cells.manipulability.size() != count ||
      cells.margin.size() != count) {
    throw Error("the map has " + std::to_string(count) + " cells, not " +
                std::to_string(cells.branches.size()));
  }
  const internal::Slabs slabs(header.grid);
  const Eigen::Index at_position = header.grid.directions() * header.grid.rolls();
  std::vector<bool> there(static_cast<std::size_t>(slabs.count()), true);
  data_ = std::make_unique<Data>(
      Data{.path = {},
           .header = std::move(header),
           .slabs = slabs,
           .there = std::move(there),
           .read = [slabs, at_position, all = std::move(cells)](Eigen::Index slab) {
             return part_of(all, slabs.first(slab) * at_position, slabs.last(slab) * at_position);
           }});
}

ReachMap::~ReachMap() = default;
ReachMap::ReachMap(ReachMap&&) noexcept = default;
ReachMap& ReachMap::operator=(ReachMap&&) noexcept = default;

const std::string& ReachMap::path() const { return data_->path; }
const ReachMapHeader& ReachMap::header() const { return data_->header; }
const std::vector<bool>& ReachMap::slabs() const { return data_->there; }

bool ReachMap::complete() const {
  return std::all_of(slabs().begin(), slabs().end(), [](bool there) { return there; });
}

ReachMap::Totals ReachMap::totals() const {
  Totals totals;
  const Eigen::Index at_position = grid().directions() * grid().rolls();
  for (Eigen::Index s = 0; s < data_->slabs.count(); ++s) {
    if (!slabs()[static_cast<std::size_t>(s)]) continue;
    const ReachCells slab = data_->read(s);
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
  for (Eigen::Index p = first; p < last;) {
    const Eigen::Index s = data_->slabs.slab_of(p);
    if (!slabs()[static_cast<std::size_t>(s)]) {
      throw FileError(path(), 0, "holds part of a map, without position " + std::to_string(p));
    }
    const Eigen::Index begin = data_->slabs.first(s), end = std::min(data_->slabs.last(s), last);
    const ReachCells slab = data_->read(s);
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
