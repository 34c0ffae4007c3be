#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include <beeline/reach/internal/map_format.h>

namespace beeline::internal {
namespace {

std::vector<MapFormat::Dataset> datasets_of(const ReachMapHeader& header, const FreeJoints& free) {
  if (!header.grid.cylindrical()) {
    return {{header.samples > 0 ? "samples" : "branches", Hdf5Type::uint8},
            {"manipulability", Hdf5Type::float32},
            {"margin", Hdf5Type::float32}};
  }
  std::vector<MapFormat::Dataset> datasets{{"branches", Hdf5Type::uint8},
                                           {"manipulability", Hdf5Type::float32, true},
                                           {"margin", Hdf5Type::float32, true},
                                           {"first_joint", Hdf5Type::float64, true}};
  if (free.roll && !free.any_roll) {
    datasets.push_back({"last_joint", Hdf5Type::float64, true});
  }
  return datasets;
}

std::size_t numbers_in(const Hdf5Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

/// Returns the values of the branches, padded with NaN to max_branches for each cell.
template <class Value>
std::vector<Value> padded(const ReachBranches& branches, const std::vector<Value>& values) {
  constexpr auto most = static_cast<std::size_t>(MapFormat::max_branches);
  std::vector<Value> all(branches.ends.size() * most, std::numeric_limits<Value>::quiet_NaN());
  for (std::size_t cell = 0; cell < branches.ends.size(); ++cell) {
    const std::size_t begin = branches.begin(cell);
    const std::size_t count = std::min(branches.ends[cell] - begin, most);
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(begin), count,
                all.begin() + static_cast<std::ptrdiff_t>(cell * most));
  }
  return all;
}

/// The inverse of padded().
template <class Value>
std::vector<Value> unpadded(const ReachBranches& branches, const std::vector<Value>& all) {
  constexpr auto most = static_cast<std::size_t>(MapFormat::max_branches);
  std::vector<Value> values;
  for (std::size_t cell = 0; cell < branches.ends.size(); ++cell) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(cell * most);
    const std::size_t count = branches.ends[cell] - branches.begin(cell);
    values.insert(values.end(), first, first + static_cast<std::ptrdiff_t>(count));
  }
  return values;
}

/// Reads the k-th dataset of a slab.
template <class Value>
std::vector<Value> values_of(const MapDatasets& datasets, const MapFormat& format, std::size_t k,
                             Eigen::Index slab) {
  const auto [begin, size] = format.box(format.datasets()[k], slab);
  std::vector<Value> values(numbers_in(size));
  datasets[k].read(begin, size, values.data());
  return values;
}

void write_values(MapDatasets& datasets, const MapFormat& format, std::size_t k, Eigen::Index slab,
                  const auto& values) {
  const auto [begin, size] = format.box(format.datasets()[k], slab);
  datasets[k].write(begin, size, values.data());
}

}  // namespace

MapFormat::MapFormat(const ReachMapHeader& header)
    : grid_(header.grid),
      slabs_(header.grid),
      free_(grid_.cylindrical() ? free_joints(header.arm, grid_, header.scene.has_value())
                                : FreeJoints{}),
      datasets_(datasets_of(header, free_)) {}

Hdf5Shape MapFormat::of_positions(std::array<Eigen::Index, 3> counts,
                                  const Dataset& dataset) const {
  Hdf5Shape shape;
  const auto add = [&shape](Eigen::Index n) {
    shape.push_back(static_cast<unsigned long long>(n));
  };
  add(counts[0]);
  add(counts[1]);
  if (!grid_.cylindrical()) add(counts[2]);
  const ReachOrientations orientations = grid_.orientations();
  const bool one =
      orientations == ReachOrientations::fixed || orientations == ReachOrientations::any;
  if (!one) add(grid_.directions());
  if (orientations == ReachOrientations::rolls && !free_.roll) add(grid_.rolls());
  if (dataset.of_branches) add(max_branches);
  return shape;
}

Hdf5Shape MapFormat::shape(const Dataset& dataset) const {
  const auto& axes = grid_.axes();
  return of_positions({axes[0].cells, axes[1].cells, axes[2].cells}, dataset);
}

Hdf5Shape MapFormat::chunk(const Dataset& dataset) const {
  return of_positions(slabs_.edges(), dataset);
}

MapFormat::Box MapFormat::box(const Dataset& dataset, Eigen::Index slab) const {
  Box box{.begin = {}, .size = of_positions(slabs_.size(slab), dataset)};
  box.begin.resize(box.size.size(), 0);
  for (std::size_t k = 0; k < (grid_.cylindrical() ? 2 : 3); ++k) {
    box.begin[k] = static_cast<unsigned long long>(slabs_.begin(slab)[k]);
  }
  return box;
}

MapDatasets create_datasets(Hdf5File& file, const MapFormat& format) {
  MapDatasets datasets;
  for (const MapFormat::Dataset& dataset : format.datasets()) {
    datasets.push_back(
        file.create(dataset.name, dataset.type, format.shape(dataset), format.chunk(dataset)));
  }
  return datasets;
}

MapDatasets open_datasets(const Hdf5File& file, const MapFormat& format) {
  MapDatasets datasets;
  for (const MapFormat::Dataset& dataset : format.datasets()) {
    datasets.push_back(
        file.open(dataset.name, dataset.type, format.shape(dataset), format.chunk(dataset)));
  }
  return datasets;
}

void write_cells(MapDatasets& datasets, const MapFormat& format, Eigen::Index slab,
                 const ReachCells& cells) {
  write_values(datasets, format, 0, slab, cells.branches);
  write_values(datasets, format, 1, slab, cells.manipulability);
  write_values(datasets, format, 2, slab, cells.margin);
}

ReachCells read_cells(const MapDatasets& datasets, const MapFormat& format, Eigen::Index slab) {
  return {values_of<std::uint8_t>(datasets, format, 0, slab),
          values_of<float>(datasets, format, 1, slab), values_of<float>(datasets, format, 2, slab)};
}

void write_branches(MapDatasets& datasets, const MapFormat& format, Eigen::Index slab,
                    const ReachBranches& branches) {
  write_values(datasets, format, 0, slab, branches.counts);
  write_values(datasets, format, 1, slab, padded(branches, branches.manipulability));
  write_values(datasets, format, 2, slab, padded(branches, branches.margin));
  write_values(datasets, format, 3, slab, padded(branches, branches.first_joint));
  if (datasets.size() > 4)
    write_values(datasets, format, 4, slab, padded(branches, branches.last_joint));
}

ReachBranches read_branches(const MapDatasets& datasets, const MapFormat& format,
                            Eigen::Index slab) {
  ReachBranches branches{.counts = values_of<std::uint8_t>(datasets, format, 0, slab)};
  std::size_t end = 0;
  for (const std::uint8_t count : branches.counts) {
    end += std::min<std::size_t>(count, MapFormat::max_branches);
    branches.ends.push_back(end);
  }
  const auto read = [&](std::size_t k, auto& values) {
    using Value = typename std::decay_t<decltype(values)>::value_type;
    values = unpadded(branches, values_of<Value>(datasets, format, k, slab));
  };
  read(1, branches.manipulability);
  read(2, branches.margin);
  read(3, branches.first_joint);
  if (datasets.size() > 4)
    read(4, branches.last_joint);
  else
    branches.last_joint.assign(branches.first_joint.size(), 0);
  return branches;
}

}  // namespace beeline::internal
