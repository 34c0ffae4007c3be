#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string_view>

#include <beeline/reach/internal/hdf5_file.h>
#include <beeline/reach/internal/map_file.h>
#include <beeline/reach/internal/map_header.h>
#include <beeline/reach/internal/parts.h>
#include <beeline/reach/internal/positions.h>

namespace beeline::internal {
namespace {

constexpr const char *header_file = "map.h5", *slab_files = "slab-";

/// Removes the digits at a text's end; whether there were any.
bool drop_number(std::string_view& text) {
  const std::size_t before = text.size();
  text = text.substr(0, text.find_last_not_of("0123456789") + 1);
  return text.size() < before;
}

bool drop(std::string_view& text, std::string_view end) {
  if (!text.ends_with(end)) return false;
  text.remove_suffix(end.size());
  return true;
}

/// Whether a file of the folder is map.h5, slab-<number>.h5, or one of these that was not written
/// to the end, <name>.<host>-<number>-<number>.part (MapWriter).
bool is_own(std::string_view name) {
  if (drop(name, ".part")) {
    if (!drop_number(name) || !drop(name, "-") || !drop_number(name) || !drop(name, "-"))
      return false;
    const std::size_t host = name.find(".h5.") + 3;
    if (host < 3 || host + 1 >= name.size()) return false;
    name = name.substr(0, host);
  }
  return drop(name, ".h5") && (name == "map" || (drop_number(name) && name == slab_files));
}

}  // namespace

std::vector<SlabRange> units_of(const ReachMapHeader& header) {
  constexpr Eigen::Index cells = Eigen::Index{1} << 24;
  const Slabs slabs(header.grid);
  const Eigen::Index in_slab =
      (slabs.last(0) - slabs.first(0)) * header.grid.directions() * header.grid.rolls();
  const Eigen::Index size = header.samples > 0 ? std::max<Eigen::Index>(1, cells / in_slab) : 1;
  std::vector<SlabRange> units;
  for (Eigen::Index first = 0; first < slabs.count(); first += size) {
    units.push_back({first, std::min(first + size, slabs.count())});
  }
  return units;
}

Parts::Parts(const std::string& map_path, const ReachMapHeader& header)
    : folder_(map_path + ".parts"), header_(header), slabs_(header.grid) {
  check_map_path(map_path);
  load_hdf5();
  std::error_code error;
  std::filesystem::create_directory(folder_, error);
  if (error) throw FileError(folder_, 0, "cannot be made: " + error.message());
  // A file of the map without slabs identifies the map of the folder.
  const std::string path = folder_ + "/" + header_file;
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
  return folder_ + "/" + slab_files + std::to_string(slab) + ".h5";
}

bool Parts::has_slab(Eigen::Index slab) const {
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

bool Parts::has(const SlabRange& unit) const {
  for (Eigen::Index slab = unit.first; slab < unit.last; ++slab) {
    if (!has_slab(slab)) return false;
  }
  return true;
}

void Parts::write(Eigen::Index slab, const auto& computed) const {
  MapWriter writer(file(slab), header_);
  writer.write(slab, computed);
  writer.commit();
}

void Parts::write_files(const SlabRange& unit, const ReachCells& cells) const {
  if (unit.last - unit.first == 1) {
    write(unit.first, cells);
    return;
  }
  const Eigen::Index at_position = header_.grid.directions() * header_.grid.rolls();
  const Eigen::Index origin = slabs_.first(unit.first);
  for (Eigen::Index slab = unit.first; slab < unit.last; ++slab) {
    write(slab, part_of(cells, (slabs_.first(slab) - origin) * at_position,
                        (slabs_.last(slab) - origin) * at_position));
  }
}

void Parts::write_with(int threads, std::function<void()> write) {
  finish();
  if (threads == 1) {
    write();
  } else {
    writing_ = std::async(std::launch::async, std::move(write));
  }
}

void Parts::finish() {
  if (writing_.valid()) writing_.get();
}

Ending Parts::compute(const SlabRange& unit, const ReachOptions& options) {
  const auto now = std::chrono::seconds(0);
  if (writing_.valid() && writing_.wait_for(now) == std::future_status::ready) finish();
  const ReachGrid& grid = header_.grid;
  const Eigen::Index first = slabs_.first(unit.first), last = slabs_.last(unit.last - 1);
  if (grid.cylindrical()) {  // a unit of one slab
    ReachBranches branches =
        reach_branches(header_.arm, grid, first / grid.azimuths(), last / grid.azimuths(), options);
    const Ending ending = branches.ending;
    if (ending != Ending::complete) return ending;
    write_with(options.threads,
               [this, slab = unit.first, all = std::move(branches)] { write(slab, all); });
    return ending;
  }
  ReachCells cells = reach_cells(header_.arm, grid, first, last, options);
  if (cells.ending != Ending::complete) return cells.ending;
  write_with(options.threads, [this, unit, all = std::move(cells)] { write_files(unit, all); });
  return Ending::complete;
}

void Parts::join(const std::vector<SlabRange>& units, const std::string& path) const {
  MapWriter writer(path, header_);
  for (const SlabRange& unit : units) {
    for (Eigen::Index slab = unit.first; slab < unit.last; ++slab) writer.copy_slabs(file(slab));
  }
  writer.commit();
}

void Parts::remove() const {
  std::error_code left;  // the map is there: what cannot be deleted does no harm
  std::vector<std::filesystem::path> files;
  const std::filesystem::directory_iterator end;
  for (std::filesystem::directory_iterator at(folder_, left); at != end; at.increment(left)) {
    const std::string name = at->path().filename().string();
    if (is_own(name)) files.push_back(at->path());
  }
  for (const std::filesystem::path& file : files) std::filesystem::remove(file, left);
  if (!std::filesystem::is_symlink(folder_, left)) std::filesystem::remove(folder_, left);
}

}  // namespace beeline::internal
