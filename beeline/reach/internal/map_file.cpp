#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <beeline/reach/internal/map_file.h>
#include <beeline/reach/internal/map_header.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace beeline::internal {
namespace {

FileError refused(const std::string& path, int error) {
  return {path, 0, std::string("cannot be written: ") + std::strerror(error)};
}

/// A file beside the path that no other writer uses.
std::string temporary_beside(const std::string& path) {
  static std::atomic<unsigned> written{0};
  char host[65] = "";
  ::gethostname(host, sizeof host - 1);  // processes on several machines may share the folder
  return path + "." + host + "-" + std::to_string(::getpid()) + "-" + std::to_string(written++) +
         ".part";
}

/// The shape of the datasets: positions, directions or headings, rolls.
Hdf5Shape dataset_shape(const ReachGrid& grid) {
  Hdf5Shape shape;
  for (const ReachAxis& axis : grid.axes()) {
    shape.push_back(static_cast<unsigned long long>(axis.cells));
  }
  const auto add = [&shape](Eigen::Index n) {
    shape.push_back(static_cast<unsigned long long>(n));
  };
  if (grid.orientations() != ReachOrientations::fixed) add(grid.directions());
  if (grid.orientations() == ReachOrientations::rolls) add(grid.rolls());
  return shape;
}

/// One chunk for each slab.
Hdf5Shape slab_chunk(const ReachGrid& grid) {
  Hdf5Shape chunk = dataset_shape(grid);
  const Slabs slabs(grid);
  for (std::size_t k = 0; k < 3; ++k) chunk[k] = static_cast<unsigned long long>(slabs.edges()[k]);
  return chunk;
}

MapDatasets create_datasets(Hdf5File& file, const ReachGrid& grid) {
  const Hdf5Shape shape = dataset_shape(grid), chunk = slab_chunk(grid);
  return {file.create("branches", Hdf5Type::uint8, shape, chunk),
          file.create("manipulability", Hdf5Type::float32, shape, chunk),
          file.create("margin", Hdf5Type::float32, shape, chunk)};
}

Hdf5Shape flags_shape(const Slabs& slabs) {
  return {static_cast<unsigned long long>(slabs.count())};
}

/// Makes what was written to a file, or to a folder, survive a loss of power.
void synchronise(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

MapDatasets open_datasets(const Hdf5File& file, const ReachGrid& grid) {
  const Hdf5Shape shape = dataset_shape(grid), chunk = slab_chunk(grid);
  return {file.open("branches", Hdf5Type::uint8, shape, chunk),
          file.open("manipulability", Hdf5Type::float32, shape, chunk),
          file.open("margin", Hdf5Type::float32, shape, chunk)};
}

std::vector<bool> read_slabs(const Hdf5File& file, const ReachGrid& grid) {
  const Hdf5Shape shape = flags_shape(Slabs(grid));
  const Hdf5Dataset dataset = file.open("slabs", Hdf5Type::uint8, shape);
  std::vector<std::uint8_t> flags(shape[0]);
  dataset.read({0}, shape, flags.data());
  return {flags.begin(), flags.end()};
}

SlabBox box_of(const ReachGrid& grid, const Slabs& slabs, Eigen::Index slab) {
  SlabBox box{.begin = Hdf5Shape(dataset_shape(grid).size(), 0), .size = dataset_shape(grid)};
  for (std::size_t k = 0; k < 3; ++k) {
    box.begin[k] = static_cast<unsigned long long>(slabs.begin(slab)[k]);
    box.size[k] = static_cast<unsigned long long>(slabs.size(slab)[k]);
  }
  return box;
}

MapWriter::MapWriter(const std::string& path, const ReachMapHeader& header)
    : path_((check_map_path(path), path)),
      temporary_(temporary_beside(path)),
      header_(header),
      slabs_(header.grid),
      written_(static_cast<std::size_t>(slabs_.count()), false),
      file_(temporary_, Hdf5File::Mode::create) {
  write_header(file_, header);
  datasets_ = std::make_unique<MapDatasets>(create_datasets(file_, header.grid));
}

MapWriter::~MapWriter() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void MapWriter::write(Eigen::Index slab, const ReachCells& cells) {
  const auto [begin, size] = box_of(header_.grid, slabs_, slab);
  datasets_->branches.write(begin, size, cells.branches.data());
  datasets_->manipulability.write(begin, size, cells.manipulability.data());
  datasets_->margin.write(begin, size, cells.margin.data());
  written_[static_cast<std::size_t>(slab)] = true;
}

void MapWriter::copy_slabs(const std::string& path) {
  const Hdf5File file(path, Hdf5File::Mode::read);
  check_same_map(path, read_header(file, path), header_);
  const MapDatasets from = open_datasets(file, header_.grid);
  const std::vector<bool> there = read_slabs(file, header_.grid);
  for (std::size_t slab = 0; slab < there.size(); ++slab) {
    if (!there[slab] || written_[slab]) continue;
    const Hdf5Shape begin = box_of(header_.grid, slabs_, static_cast<Eigen::Index>(slab)).begin;
    datasets_->branches.write_chunk(begin, from.branches.read_chunk(begin));
    datasets_->manipulability.write_chunk(begin, from.manipulability.read_chunk(begin));
    datasets_->margin.write_chunk(begin, from.margin.read_chunk(begin));
    written_[slab] = true;
  }
}

void MapWriter::commit() {
  const Hdf5Shape shape = flags_shape(slabs_);
  const std::vector<std::uint8_t> flags(written_.begin(), written_.end());
  file_.create("slabs", Hdf5Type::uint8, shape).write({0}, shape, flags.data());
  datasets_.reset();
  file_.close();
  synchronise(temporary_);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) throw refused(path_, errno);
  temporary_.clear();
  synchronise(std::filesystem::absolute(path_).parent_path().string());
}

void check_map_path(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) throw FileError(path, 0, "cannot be written: it is a folder");
    if (!S_ISREG(status.st_mode)) {
      throw FileError(path, 0, "cannot be written: a reach map needs a file, not a pipe or device");
    }
    if (::access(path.c_str(), W_OK) != 0) throw refused(path, errno);
    return;
  }
  const std::string folder = std::filesystem::absolute(path).parent_path().string();
  if (::stat(folder.c_str(), &status) != 0) throw refused(path, errno);
  if (!S_ISDIR(status.st_mode)) throw refused(path, ENOTDIR);
  if (::access(folder.c_str(), W_OK) != 0) throw refused(path, errno);
}

}  // namespace beeline::internal
