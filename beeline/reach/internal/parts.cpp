#include <filesystem>

#include <beeline/reach/internal/map_file.h>
#include <beeline/reach/internal/map_header.h>
#include <beeline/reach/internal/parts.h>

namespace beeline::internal {

Parts::Parts(const std::string& map_path, const ReachMapHeader& header)
    : folder_(map_path + ".parts"), header_(header), slabs_(header.grid) {
  check_map_path(map_path);
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error) throw FileError(folder_, 0, "cannot be made: " + error.message());
  // A file of the map without slabs says what the folder is of.
  const std::string path = folder_ + "/map.h5";
  if (!std::filesystem::exists(path)) {
    MapWriter(path, header).commit();
    return;
  }
  try {
    check_same_map(path, read_header(Hdf5File(path, Hdf5File::Mode::read), path), header);
  } catch (const Error& other) {
    throw Error(std::string(other.what()) + "; to compute this one, delete " + folder_);
  }
}

std::string Parts::file(Eigen::Index slab) const {
  return folder_ + "/slab-" + std::to_string(slab) + ".h5";
}

bool Parts::has(Eigen::Index slab) const {
  const std::string path = file(slab);
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown)) return false;
  try {
    const ReachMap map(path);
    check_same_map(path, map.header(), header_);
    (void)map.cells(slabs_.first(slab), slabs_.first(slab) + 1);  // reads it, with its checksums
    return true;
  } catch (const FileError&) {  // cut off, or of the folder's former map: computed again
    return false;
  }
}

Ending Parts::compute(Eigen::Index slab, const ReachOptions& options) const {
  const Eigen::Index first = slabs_.first(slab), last = slabs_.last(slab);
  const auto write = [&](const auto& computed) {
    if (computed.ending != Ending::complete) return computed.ending;
    MapWriter writer(file(slab), header_);
    writer.write(slab, computed);
    writer.commit();
    return Ending::complete;
  };
  const auto& [arm, grid, redundant_values, samples] = header_;
  if (!grid.cylindrical()) return write(reach_cells(arm, grid, first, last, options));
  const Eigen::Index azimuths = grid.azimuths();
  return write(reach_branches(arm, grid, first / azimuths, last / azimuths, options));
}

void Parts::join(const std::vector<Eigen::Index>& slabs, const std::string& path) const {
  MapWriter writer(path, header_);
  for (const Eigen::Index slab : slabs) writer.copy_slabs(file(slab));
  writer.commit();
}

void Parts::remove() const {
  std::error_code left;  // the map is there: what cannot be deleted does no harm
  std::filesystem::remove_all(folder_, left);
}

}  // namespace beeline::internal
