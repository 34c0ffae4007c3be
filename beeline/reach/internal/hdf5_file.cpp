#include <algorithm>
#include <filesystem>
#include <limits>
#include <mutex>
#include <utility>

#include <beeline/error.h>
#include <beeline/reach/internal/hdf5_file.h>

#include <hdf5.h>

namespace beeline::internal {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>);

namespace {

/// Held by each function here while it calls the library, which is not thread-safe, not even for
/// different files.
std::unique_lock<std::recursive_mutex> turn() {
  static std::recursive_mutex mutex;
  return std::unique_lock(mutex);
}

/// Returns the reason of the library's last error, or the system's reason if there is one.
std::string last_reason() {
  std::string reason;
  const auto collect = [](unsigned, const H5E_error2_t* error, void* data) -> herr_t {
    auto& text = *static_cast<std::string*>(data);
    const std::string description = error->desc == nullptr ? "" : error->desc;
    const std::string before = "error message = '";
    const std::size_t begin = description.find(before);
    if (begin != std::string::npos) {
      text = description.substr(begin + before.size());
      text = text.substr(0, text.find('\''));
    } else if (text.empty()) {
      text = description;
    }
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect, &reason);
  return reason;
}

/// Returns a result of the library. Throws FileError for a negative one, an error.
template <class Result>
Result checked(Result result, const std::string& path, const std::string& what) {
  if (result >= 0) return result;
  const std::string reason = last_reason();
  throw FileError(path, 0, what + (reason.empty() ? "" : ": " + reason));
}

hid_t native(Hdf5Type type) {
  if (type == Hdf5Type::uint8) return H5T_NATIVE_UINT8;
  return type == Hdf5Type::float32 ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE;
}

/// The type in files, the same on every machine.
hid_t stored(Hdf5Type type) {
  if (type == Hdf5Type::uint8) return H5T_STD_U8LE;
  return type == Hdf5Type::float32 ? H5T_IEEE_F32LE : H5T_IEEE_F64LE;
}

/// The library's integer is `unsigned long long` before HDF5 1.14 and `uint64_t` since.
std::vector<hsize_t> sizes_of(const Hdf5Shape& shape) { return {shape.begin(), shape.end()}; }

Hdf5Id space_of(const Hdf5Shape& shape) {
  return {H5Screate_simple(static_cast<int>(shape.size()), sizes_of(shape).data(), nullptr),
          H5Sclose};
}

Hdf5Shape shape_of(hid_t space) {
  std::vector<hsize_t> sizes(
      static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
  return {sizes.begin(), sizes.end()};
}

Hdf5Shape chunk_of(hid_t properties, std::size_t axes) {
  if (H5Pget_layout(properties) != H5D_CHUNKED) return {};
  std::vector<hsize_t> sizes(axes);
  H5Pget_chunk(properties, static_cast<int>(axes), sizes.data());
  return {sizes.begin(), sizes.end()};
}

}  // namespace

Hdf5Id& Hdf5Id::operator=(Hdf5Id&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(close_, other.close_);
  return *this;
}

int Hdf5Id::reset() {
  const auto lock = turn();
  const std::int64_t id = std::exchange(id_, -1);
  return id < 0 ? 0 : close_(id);
}

void Hdf5Dataset::transfer(const Hdf5Shape& begin, const Hdf5Shape& size, void* values,
                           Hdf5Type type, bool write) const {
  const auto lock = turn();
  const Hdf5Id file_space(H5Dget_space(id_.get()), H5Sclose), memory_space = space_of(size);
  checked(H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, sizes_of(begin).data(), nullptr,
                              sizes_of(size).data(), nullptr),
          path_, "has no such cells");
  const hid_t memory = memory_space.get(), file = file_space.get();
  checked(write ? H5Dwrite(id_.get(), native(type), memory, file, H5P_DEFAULT, values)
                : H5Dread(id_.get(), native(type), memory, file, H5P_DEFAULT, values),
          path_, write ? "cannot be written" : "cannot be read");
}

std::vector<std::byte> Hdf5Dataset::read_chunk(const Hdf5Shape& begin) const {
  const auto lock = turn();
  hsize_t size = 0;
  checked(H5Dget_chunk_storage_size(id_.get(), sizes_of(begin).data(), &size), path_,
          "cannot be read");
  constexpr hsize_t most = hsize_t{1} << 31;  // larger than any that is written
  if (size > most)
    throw FileError(path_, 0, "is damaged: a chunk has " + std::to_string(size) + " bytes");
  std::vector<std::byte> bytes(size);
  std::uint32_t filters = 0;
  checked(H5Dread_chunk(id_.get(), H5P_DEFAULT, sizes_of(begin).data(), &filters, bytes.data()),
          path_, "cannot be read");
  if (filters != 0) throw FileError(path_, 0, "is damaged: a chunk is not compressed");
  return bytes;
}

void Hdf5Dataset::write_chunk(const Hdf5Shape& begin, const std::vector<std::byte>& bytes) {
  const auto lock = turn();
  checked(
      H5Dwrite_chunk(id_.get(), H5P_DEFAULT, 0, sizes_of(begin).data(), bytes.size(), bytes.data()),
      path_, "cannot be written");
}

Hdf5File::Hdf5File(const std::string& path, Mode mode) : path_(path) {
  // All files are closed here. What the library would do at the program's end crashes it after a
  // file that could not be written, on a full disk (1.10.8).
  [[maybe_unused]] static const int first_call = H5dont_atexit();
  const auto lock = turn();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are thrown, not printed
  if (mode == Mode::read) {
    std::error_code unknown;  // opening a pipe would wait for its other end
    if (std::filesystem::is_fifo(path, unknown)) {
      throw FileError(path, 0, "is not a reach map that can be read: it is a pipe");
    }
    id_ = {checked(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), path,
                   "is not a reach map that can be read"),
           H5Fclose};
    return;
  }
  // The library checks this format by checksums; damaged files of the older one may crash it.
  const Hdf5Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose),
      access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_obj_track_times(creation.get(), false);  // files with equal content are equal
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  id_ = {checked(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), path,
                 "cannot be written"),
         H5Fclose};
}

// Of fixed length: the library follows the references of others without checking them.
void Hdf5File::write_text(const char* attribute, const std::string& text) {
  const auto lock = turn();
  const Hdf5Id type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
  H5Tset_size(type.get(), std::max<std::size_t>(1, text.size()));
  H5Tset_strpad(type.get(), H5T_STR_NULLPAD);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  const Hdf5Id id(
      H5Acreate2(id_.get(), attribute, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  checked(id.get() < 0 ? -1 : H5Awrite(id.get(), type.get(), text.c_str()), path_,
          "cannot be written");
}

void Hdf5File::write_numbers(const char* attribute, const std::vector<double>& numbers) {
  const auto lock = turn();
  const Hdf5Id space =
      numbers.size() == 1 ? Hdf5Id(H5Screate(H5S_SCALAR), H5Sclose) : space_of({numbers.size()});
  const Hdf5Id id(
      H5Acreate2(id_.get(), attribute, H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  checked(id.get() < 0 ? -1 : H5Awrite(id.get(), H5T_NATIVE_DOUBLE, numbers.data()), path_,
          "cannot be written");
}

std::string Hdf5File::read_text(const char* attribute) const {
  const auto lock = turn();
  const std::string without = std::string("is no reach map: it has no text ") + attribute;
  const Hdf5Id id(checked(H5Aopen(id_.get(), attribute, H5P_DEFAULT), path_, without), H5Aclose);
  const Hdf5Id type(H5Aget_type(id.get()), H5Tclose), space(H5Aget_space(id.get()), H5Sclose);
  constexpr std::size_t most = std::size_t{64} << 20;
  const std::size_t size = H5Tget_size(type.get());
  if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0 ||
      size > most || H5Sget_simple_extent_npoints(space.get()) != 1) {
    throw FileError(path_, 0, without);
  }
  std::string text(size, '\0');
  checked(H5Aread(id.get(), type.get(), text.data()), path_, without);
  return text.substr(0, text.find('\0'));
}

std::vector<double> Hdf5File::read_numbers(const char* attribute, std::size_t count) const {
  const auto lock = turn();
  const std::string without =
      std::string("is no reach map: it has no ") + std::to_string(count) + " numbers " + attribute;
  const Hdf5Id id(checked(H5Aopen(id_.get(), attribute, H5P_DEFAULT), path_, without), H5Aclose);
  const Hdf5Id space(H5Aget_space(id.get()), H5Sclose);
  if (H5Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(count)) {
    throw FileError(path_, 0, without);
  }
  std::vector<double> numbers(count);
  checked(H5Aread(id.get(), H5T_NATIVE_DOUBLE, numbers.data()), path_, without);
  return numbers;
}

Hdf5Dataset Hdf5File::create(const char* name, Hdf5Type type, const Hdf5Shape& shape,
                             const Hdf5Shape& chunk) {
  const auto lock = turn();
  const Hdf5Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), space = space_of(shape);
  if (!chunk.empty()) {
    constexpr unsigned deflate = 4;
    H5Pset_chunk(properties.get(), static_cast<int>(chunk.size()), sizes_of(chunk).data());
    H5Pset_shuffle(properties.get());
    H5Pset_deflate(properties.get(), deflate);
    H5Pset_fletcher32(properties.get());  // damage is noticed when it is read
  }
  if (type != Hdf5Type::uint8) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    H5Pset_fill_value(properties.get(), H5T_NATIVE_DOUBLE, &unknown);
  }
  H5Pset_obj_track_times(properties.get(), false);
  return {Hdf5Id(checked(H5Dcreate2(id_.get(), name, stored(type), space.get(), H5P_DEFAULT,
                                    properties.get(), H5P_DEFAULT),
                         path_, "cannot be written"),
                 H5Dclose),
          path_};
}

Hdf5Dataset Hdf5File::open(const char* name, Hdf5Type type, const Hdf5Shape& shape,
                           const Hdf5Shape& chunk) const {
  const auto lock = turn();
  Hdf5Id id(checked(H5Dopen2(id_.get(), name, H5P_DEFAULT), path_,
                    std::string("is no reach map: it has no dataset ") + name),
            H5Dclose);
  const Hdf5Id space(H5Dget_space(id.get()), H5Sclose),
      stored_type(H5Dget_type(id.get()), H5Tclose),
      properties(H5Dget_create_plist(id.get()), H5Pclose);
  if (H5Tequal(stored_type.get(), stored(type)) <= 0 || shape_of(space.get()) != shape ||
      chunk_of(properties.get(), shape.size()) != chunk) {
    throw FileError(path_, 0,
                    std::string("is no reach map: its dataset ") + name +
                        " has not the type, shape and chunks of its grid");
  }
  return {std::move(id), path_};
}

void Hdf5File::close() {
  const auto lock = turn();
  checked(H5Fflush(id_.get(), H5F_SCOPE_GLOBAL), path_, "cannot be written");
  checked(id_.reset(), path_, "cannot be written");
}

}  // namespace beeline::internal
