#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/temporary_file.h>
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

std::vector<bool> read_slabs(const Hdf5File& file, const ReachGrid& grid) {
  const Hdf5Shape shape = flags_shape(Slabs(grid));
  const Hdf5Dataset dataset = file.open("slabs", Hdf5Type::uint8, shape);
  std::vector<std::uint8_t> flags(shape[0]);
  dataset.read({0}, shape, flags.data());
  return {flags.begin(), flags.end()};
}

MapWriter::MapWriter(const std::string& path, const ReachMapHeader& header)
    : path_((check_map_path(path), file_replaced_at(path))),
      temporary_(temporary_beside(path_)),
      header_(header),
      format_(header),
      written_(static_cast<std::size_t>(format_.slabs().count()), false),
      file_(temporary_, Hdf5File::Mode::create) {
  write_header(file_, header);
  datasets_ = create_datasets(file_, format_);
}

MapWriter::~MapWriter() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void MapWriter::write(Eigen::Index slab, const ReachCells& cells) {
  write_cells(datasets_, format_, slab, cells);
  written_[static_cast<std::size_t>(slab)] = true;
}

void MapWriter::write(Eigen::Index slab, const ReachBranches& branches) {
  write_branches(datasets_, format_, slab, branches);
  written_[static_cast<std::size_t>(slab)] = true;
}

void MapWriter::copy_slabs(const std::string& path) {
  const Hdf5File file(path, Hdf5File::Mode::read);
  check_same_map(path, read_header(file, path), header_);
  const MapDatasets from = open_datasets(file, format_);
  const std::vector<bool> is_filled = read_slabs(file, header_.grid);
  for (std::size_t slab = 0; slab < is_filled.size(); ++slab) {
    if (!is_filled[slab] || written_[slab]) continue;
    for (std::size_t k = 0; k < from.size(); ++k) {
      const Hdf5Shape begin =
          format_.box(format_.datasets()[k], static_cast<Eigen::Index>(slab)).begin;
      datasets_[k].write_chunk(begin, from[k].read_chunk(begin));
    }
    written_[slab] = true;
  }
}

void MapWriter::commit() {
  const Hdf5Shape shape = flags_shape(format_.slabs());
  const std::vector<std::uint8_t> flags(written_.begin(), written_.end());
  file_.create("slabs", Hdf5Type::uint8, shape).write({0}, shape, flags.data());
  datasets_.clear();
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
