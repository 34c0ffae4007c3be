#include <algorithm>

#include <beeline/reach/internal/map_data.h>
#include <beeline/reach/internal/positions.h>

namespace beeline {

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
  std::vector<bool> is_filled(static_cast<std::size_t>(slabs.count()), true);
  data_ = std::make_unique<Data>(
      Data{.path = {},
           .header = std::move(header),
           .slabs = slabs,
           .is_filled = std::move(is_filled),
           .read = [at_position, all = std::move(cells)](Eigen::Index first, Eigen::Index last) {
             return internal::part_of(all, first * at_position, last * at_position);
           }});
}

ReachMap::~ReachMap() = default;
ReachMap::ReachMap(ReachMap&&) noexcept = default;
ReachMap& ReachMap::operator=(ReachMap&&) noexcept = default;

const std::string& ReachMap::path() const { return data_->path; }
const ReachMapHeader& ReachMap::header() const { return data_->header; }
const std::vector<bool>& ReachMap::slabs() const { return data_->is_filled; }

bool ReachMap::complete() const {
  return std::all_of(slabs().begin(), slabs().end(), [](bool filled) { return filled; });
}

bool ReachMap::has(Eigen::Index position) const {
  internal::check_positions(grid(), position, position + 1);
  return slabs()[static_cast<std::size_t>(data_->slabs.slab_of(position))];
}

Eigen::Index ReachMap::block_end(Eigen::Index position) const {
  internal::check_positions(grid(), position, position + 1);
  return std::min(position + internal::positions_at_once(grid()),
                  data_->slabs.last(data_->slabs.slab_of(position)));
}

std::vector<Eigen::Index> ReachMap::reached_in(Eigen::Index slab) const {
  if (data_->reached) return data_->reached(slab);
  std::vector<Eigen::Index> reached;
  const Eigen::Index at_position = grid().directions() * grid().rolls();
  const Eigen::Index block = internal::positions_at_once(grid()), last = data_->slabs.last(slab);
  for (Eigen::Index first = data_->slabs.first(slab); first < last; first += block) {
    const ReachCells some = data_->read(first, std::min(last, first + block));
    for (auto at = some.branches.begin(); at != some.branches.end(); at += at_position) {
      reached.push_back(at_position - std::count(at, at + at_position, 0));
    }
  }
  return reached;
}

ReachMap::Totals ReachMap::totals() const {
  Totals totals;
  for (Eigen::Index s = 0; s < data_->slabs.count(); ++s) {
    if (!slabs()[static_cast<std::size_t>(s)]) continue;
    Eigen::Index p = data_->slabs.first(s);
    for (const Eigen::Index reached : reached_in(s)) {
      totals.cells += grid().directions() * grid().rolls();
      totals.reached += reached;
      ++totals.positions;
      totals.reached_positions += reached > 0;
      if (reached > 0) totals.volume += grid().volume(p);
      ++p;
    }
  }
  return totals;
}

ReachCells ReachMap::cells(Eigen::Index first, Eigen::Index last) const {
  internal::check_positions(grid(), first, last);
  ReachCells cells;
  for (Eigen::Index p = first; p < last;) {
    const Eigen::Index s = data_->slabs.slab_of(p), end = std::min(data_->slabs.last(s), last);
    if (!slabs()[static_cast<std::size_t>(s)]) {
      throw FileError(path(), 0, "holds part of a map, without position " + std::to_string(p));
    }
    const ReachCells some = data_->read(p, end);
    const auto join = [](auto& all, const auto& more) {
      all.insert(all.end(), more.begin(), more.end());
    };
    join(cells.branches, some.branches);
    join(cells.manipulability, some.manipulability);
    join(cells.margin, some.margin);
    p = end;
  }
  return cells;
}

}  // namespace beeline
