#include <memory>

#include <beeline/reach/internal/map_data.h>
#include <beeline/reach/internal/map_file.h>
#include <beeline/reach/internal/map_header.h>

namespace beeline {

ReachMap::ReachMap(const std::string& path) {
  auto file = std::make_shared<internal::Hdf5File>(path, internal::Hdf5File::Mode::read);
  const ReachMapHeader header = internal::read_header(*file, path);
  const internal::Slabs slabs(header.grid);
  const auto datasets =
      std::make_shared<internal::MapDatasets>(internal::open_datasets(*file, header.grid));
  std::vector<bool> there = internal::read_slabs(*file, header.grid);
  const Eigen::Index at_position = header.grid.directions() * header.grid.rolls();
  // One slab is one chunk of the file, which is decompressed as a whole.
  const auto read = [=, grid = header.grid](Eigen::Index slab) {
    ReachCells cells;
    cells.resize(static_cast<std::size_t>((slabs.last(slab) - slabs.first(slab)) * at_position));
    const auto [begin, size] = internal::box_of(grid, slabs, slab);
    datasets->branches.read(begin, size, cells.branches.data());
    datasets->manipulability.read(begin, size, cells.manipulability.data());
    datasets->margin.read(begin, size, cells.margin.data());
    return cells;
  };
  data_ =
      std::make_unique<Data>(Data{.path = path,
                                  .header = header,
                                  .slabs = slabs,
                                  .there = std::move(there),
                                  .read = [file, read](Eigen::Index slab) { return read(slab); }});
}

}  // namespace beeline
