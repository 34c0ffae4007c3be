#include "reach_arrays.h"

namespace beeline::python {
namespace {

constexpr double most_cells = 4e9;  // 36 GB

template <class T, class Values>
KeptArray<T> array_of(std::span<const Index> shape, const Values& values) {
  KeptArray<T> array = kept_array<T>(shape);
  std::ranges::copy(values, array.data());
  return array;
}

Index at_position(const ReachGrid& grid) { return grid.directions() * grid.rolls(); }

/// The shape of one value for each of `count` positions.
std::vector<Index> positions_shape(const ReachGrid& grid, Index count) {
  if (count != grid.positions()) return {count};
  std::vector<Index> shape;
  for (const ReachAxis& axis : grid.axes()) shape.push_back(axis.cells);
  return shape;
}

/// Adds the dimensions of the orientations.
std::vector<Index> with_orientations(std::vector<Index> shape, const ReachGrid& grid) {
  if (has_directions(grid)) shape.push_back(grid.directions());
  if (grid.orientations() == ReachOrientations::rolls) shape.push_back(grid.rolls());
  return shape;
}

}  // namespace

bool has_directions(const ReachGrid& grid) {
  using enum ReachOrientations;
  const ReachOrientations kind = grid.orientations();
  return kind == headings || kind == directions || kind == rolls;
}

bool same_grid(const ReachGrid& a, const ReachGrid& b) {
  return a.orientations() == b.orientations() &&
         Value<ReachGridOptions>::same(a.options(), b.options());
}

std::vector<Index> cells_shape(const ReachGrid& grid, Index count) {
  const double cells = static_cast<double>(count) * static_cast<double>(at_position(grid));
  if (cells > most_cells) {
    throw Error(number(cells) +
                " cells are more than the 4e9 that are kept in memory; compute_reach_map() writes "
                "them to a file");
  }
  return with_orientations(positions_shape(grid, count), grid);
}

CellWriter::CellWriter(const ReachGrid& grid, Index count) {
  const std::vector<Index> shape = cells_shape(grid, count);
  arrays_ = {kept_array<std::uint8_t>(shape), kept_array<float>(shape), kept_array<float>(shape)};
}

void CellWriter::append(const ReachCells& cells) {
  std::ranges::copy(cells.branches, arrays_.branches.data() + written_);
  std::ranges::copy(cells.manipulability, arrays_.manipulability.data() + written_);
  std::ranges::copy(cells.margin, arrays_.margin.data() + written_);
  written_ += std::ssize(cells.branches);
}

CellArrays CellWriter::finish(Ending ending) {
  arrays_.ending = ending;
  return std::move(arrays_);
}

CellArrays arrays_of(const ReachGrid& grid, const ReachCells& cells) {
  CellWriter writer(grid, std::ssize(cells.branches) / at_position(grid));
  writer.append(cells);
  return writer.finish(cells.ending);
}

ReachCells cells_of(const ReachGrid& grid, const CellArrays& arrays) {
  if (!arrays) throw Error("the cells were not computed to the end");
  const auto shape = arrays.branches.shape();
  const Index count = arrays.branches.size() / at_position(grid);
  if (!std::ranges::equal(shape, with_orientations(positions_shape(grid, count), grid)) &&
      !std::ranges::equal(shape, with_orientations({count}, grid))) {
    const auto all = with_orientations(positions_shape(grid, grid.positions()), grid);
    throw Error("the cells have the shape " + shape_text(shape) + "; the cells of the grid have " +
                shape_text(all) + ", or (N, ...) for N positions");
  }
  const auto copied = [](const auto& array) {
    return std::vector(array.data(), array.data() + array.size());
  };
  return {copied(arrays.branches), copied(arrays.manipulability), copied(arrays.margin)};
}

PositionArrays summary_of(const ReachGrid& grid, const ReachCells& cells) {
  const ReachPositions best = [&] {
    const LockRelease release;
    return reach_positions(grid, cells);
  }();
  const std::vector<Index> shape = positions_shape(grid, std::ssize(best.branches));
  return {array_of<float>(shape, best.directions), array_of<std::uint8_t>(shape, best.branches),
          array_of<float>(shape, best.manipulability), array_of<float>(shape, best.margin)};
}

}  // namespace beeline::python
