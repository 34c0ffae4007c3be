#include <algorithm>

#include <beeline/reach/internal/slabs.h>

namespace beeline::internal {
namespace {

Eigen::Index quotient_up(Eigen::Index a, Eigen::Index b) { return (a + b - 1) / b; }

}  // namespace

Slabs::Slabs(const ReachGrid& grid) {
  constexpr Eigen::Index wanted = 1024, smallest = Eigen::Index{1} << 16,
                         largest = Eigen::Index{1} << 22,
                         largest_of_branches = Eigen::Index{1} << 18;
  for (int k = 0; k < 3; ++k) cells_[k] = grid.axes()[k].cells;
  const Eigen::Index at_position = grid.directions() * grid.rolls();
  const Eigen::Index in_slab = std::clamp(grid.cells() / grid.azimuths() / wanted, smallest,
                                          grid.cylindrical() ? largest_of_branches : largest);
  Eigen::Index left = std::max<Eigen::Index>(1, in_slab / at_position);
  if (grid.cylindrical()) left *= grid.azimuths();
  // Whole columns along z come first, then whole rows of columns along y, then layers along x.
  for (int k = 2; k >= 0; --k) {
    edges_[k] = std::min(left, cells_[k]);
    left = edges_[k] < cells_[k] ? 1 : std::max<Eigen::Index>(1, left / cells_[k]);
  }
  per_x_ = quotient_up(cells_[0], edges_[0]);
  per_row_ = quotient_up(cells_[1], edges_[1]);
  per_column_ = quotient_up(cells_[2], edges_[2]);
  constexpr double most = 1 << 20;
  const double slabs = static_cast<double>(per_x_) * static_cast<double>(per_row_) *
                       static_cast<double>(per_column_);
  if (slabs > most) {
    throw Error("the map would have " + number(static_cast<double>(grid.cells())) +
                " cells in more than a million slabs: a coarser resolution or larger angles have "
                "fewer");
  }
}

std::array<Eigen::Index, 3> Slabs::begin(Eigen::Index s) const {
  return {s / (per_column_ * per_row_) * edges_[0], s / per_column_ % per_row_ * edges_[1],
          s % per_column_ * edges_[2]};
}

std::array<Eigen::Index, 3> Slabs::size(Eigen::Index s) const {
  std::array<Eigen::Index, 3> size = begin(s);
  for (int k = 0; k < 3; ++k) size[k] = std::min(edges_[k], cells_[k] - size[k]);
  return size;
}

Eigen::Index Slabs::first(Eigen::Index s) const {
  const auto [x, y, z] = begin(s);
  return (x * cells_[1] + y) * cells_[2] + z;
}

Eigen::Index Slabs::last(Eigen::Index s) const {
  const auto [x, y, z] = size(s);
  return first(s) + x * y * z;
}

Eigen::Index Slabs::slab_of(Eigen::Index position) const {
  const Eigen::Index x = position / (cells_[1] * cells_[2]);
  const Eigen::Index y = position / cells_[2] % cells_[1], z = position % cells_[2];
  return (x / edges_[0] * per_row_ + y / edges_[1]) * per_column_ + z / edges_[2];
}

}  // namespace beeline::internal
