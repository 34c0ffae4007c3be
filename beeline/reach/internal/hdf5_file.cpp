#include <algorithm>
#include <filesystem>
#include <limits>
#include <mutex>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/shared_library.h>
#include <beeline/reach/internal/hdf5_file.h>

#include <hdf5.h>

// HDF5's constants call these two functions.
#undef H5OPEN
#undef H5CHECK
#define H5OPEN
#define H5CHECK

namespace beeline::internal {

static_assert(std::is_same_v<hid_t, std::int64_t> && std::is_same_v<herr_t, int>);

namespace {

// NOLINTBEGIN(readability-identifier-naming): the names are HDF5's.
/// The functions and the identifiers of HDF5 that are used here, without their prefix H5.
struct Hdf5 {
  SharedLibrary library{BEELINE_HDF5_LIBRARY, "install HDF5"};
#define BEELINE_FUNCTION(name) decltype(::H5##name)* name = library["H5" #name]
  BEELINE_FUNCTION(dont_atexit);
  BEELINE_FUNCTION(open);
  BEELINE_FUNCTION(Aclose);
  BEELINE_FUNCTION(Acreate2);
  BEELINE_FUNCTION(Aget_space);
  BEELINE_FUNCTION(Aget_type);
  BEELINE_FUNCTION(Aopen);
  BEELINE_FUNCTION(Aread);
  BEELINE_FUNCTION(Awrite);
  BEELINE_FUNCTION(Dclose);
  BEELINE_FUNCTION(Dcreate2);
  BEELINE_FUNCTION(Dget_chunk_storage_size);
  BEELINE_FUNCTION(Dget_create_plist);
  BEELINE_FUNCTION(Dget_space);
  BEELINE_FUNCTION(Dget_type);
  BEELINE_FUNCTION(Dopen2);
  BEELINE_FUNCTION(Dread);
  BEELINE_FUNCTION(Dread_chunk);
  BEELINE_FUNCTION(Dwrite);
  BEELINE_FUNCTION(Dwrite_chunk);
  BEELINE_FUNCTION(Eset_auto2);
  BEELINE_FUNCTION(Ewalk2);
  BEELINE_FUNCTION(Fclose);
  BEELINE_FUNCTION(Fcreate);
  BEELINE_FUNCTION(Fflush);
  BEELINE_FUNCTION(Fopen);
  BEELINE_FUNCTION(Pclose);
  BEELINE_FUNCTION(Pcreate);
  BEELINE_FUNCTION(Pget_chunk);
  BEELINE_FUNCTION(Pget_layout);
  BEELINE_FUNCTION(Pset_chunk);
  BEELINE_FUNCTION(Pset_deflate);
  BEELINE_FUNCTION(Pset_fill_value);
  BEELINE_FUNCTION(Pset_fletcher32);
  BEELINE_FUNCTION(Pset_libver_bounds);
  BEELINE_FUNCTION(Pset_obj_track_times);
  BEELINE_FUNCTION(Pset_shuffle);
  BEELINE_FUNCTION(Sclose);
  BEELINE_FUNCTION(Screate);
  BEELINE_FUNCTION(Screate_simple);
  BEELINE_FUNCTION(Sget_simple_extent_dims);
  BEELINE_FUNCTION(Sget_simple_extent_ndims);
  BEELINE_FUNCTION(Sget_simple_extent_npoints);
  BEELINE_FUNCTION(Sselect_hyperslab);
  BEELINE_FUNCTION(Tclose);
  BEELINE_FUNCTION(Tcopy);
  BEELINE_FUNCTION(Tequal);
  BEELINE_FUNCTION(Tget_class);
  BEELINE_FUNCTION(Tget_size);
  BEELINE_FUNCTION(Tis_variable_str);
  BEELINE_FUNCTION(Tset_cset);
  BEELINE_FUNCTION(Tset_size);
  BEELINE_FUNCTION(Tset_strpad);
#undef BEELINE_FUNCTION

  // All files are closed here. What the library would do at the program's end crashes it after a
  // file that could not be written, on a full disk (1.10.8).
  int nothing_at_exit = dont_atexit();
  int has_identifiers = open();
#define BEELINE_IDENTIFIER(name) hid_t name = *static_cast<hid_t*>(library["H5" #name "_g"])
  BEELINE_IDENTIFIER(P_CLS_DATASET_CREATE_ID);
  BEELINE_IDENTIFIER(P_CLS_FILE_ACCESS_ID);
  BEELINE_IDENTIFIER(P_CLS_FILE_CREATE_ID);
  BEELINE_IDENTIFIER(T_C_S1);
  BEELINE_IDENTIFIER(T_IEEE_F32LE);
  BEELINE_IDENTIFIER(T_IEEE_F64LE);
  BEELINE_IDENTIFIER(T_NATIVE_DOUBLE);
  BEELINE_IDENTIFIER(T_NATIVE_FLOAT);
  BEELINE_IDENTIFIER(T_NATIVE_UINT8);
  BEELINE_IDENTIFIER(T_STD_U8LE);
#undef BEELINE_IDENTIFIER
};
// NOLINTEND(readability-identifier-naming)

/// HDF5, loaded by the first call. Throws Error where it cannot be.
const Hdf5& h5() {
  static const Hdf5 library;
  if (library.has_identifiers < 0) throw Error("HDF5 cannot be started");
  return library;
}

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
  h5().Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect, &reason);
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
  if (type == Hdf5Type::uint8) return h5().T_NATIVE_UINT8;
  return type == Hdf5Type::float32 ? h5().T_NATIVE_FLOAT : h5().T_NATIVE_DOUBLE;
}

/// The type in files, the same on every machine.
hid_t stored(Hdf5Type type) {
  if (type == Hdf5Type::uint8) return h5().T_STD_U8LE;
  return type == Hdf5Type::float32 ? h5().T_IEEE_F32LE : h5().T_IEEE_F64LE;
}

/// The library's integer is `unsigned long long` before HDF5 1.14 and `uint64_t` since.
std::vector<hsize_t> sizes_of(const Hdf5Shape& shape) { return {shape.begin(), shape.end()}; }

Hdf5Id space_of(const Hdf5Shape& shape) {
  return {h5().Screate_simple(static_cast<int>(shape.size()), sizes_of(shape).data(), nullptr),
          h5().Sclose};
}

Hdf5Shape shape_of(hid_t space) {
  std::vector<hsize_t> sizes(
      static_cast<std::size_t>(std::max(0, h5().Sget_simple_extent_ndims(space))));
  h5().Sget_simple_extent_dims(space, sizes.data(), nullptr);
  return {sizes.begin(), sizes.end()};
}

Hdf5Shape chunk_of(hid_t properties, std::size_t axes) {
  if (h5().Pget_layout(properties) != H5D_CHUNKED) return {};
  std::vector<hsize_t> sizes(axes);
  h5().Pget_chunk(properties, static_cast<int>(axes), sizes.data());
  return {sizes.begin(), sizes.end()};
}

}  // namespace

void load_hdf5() { h5(); }

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
  const Hdf5Id file_space(h5().Dget_space(id_.get()), h5().Sclose), memory_space = space_of(size);
  checked(h5().Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, sizes_of(begin).data(), nullptr,
                                 sizes_of(size).data(), nullptr),
          path_, "has no such cells");
  const hid_t memory = memory_space.get(), file = file_space.get();
  checked(write ? h5().Dwrite(id_.get(), native(type), memory, file, H5P_DEFAULT, values)
                : h5().Dread(id_.get(), native(type), memory, file, H5P_DEFAULT, values),
          path_, write ? "cannot be written" : "cannot be read");
}

std::vector<std::byte> Hdf5Dataset::read_chunk(const Hdf5Shape& begin) const {
  const auto lock = turn();
  hsize_t size = 0;
  checked(h5().Dget_chunk_storage_size(id_.get(), sizes_of(begin).data(), &size), path_,
          "cannot be read");
  constexpr hsize_t most = hsize_t{1} << 31;  // larger than any that is written
  if (size > most)
    throw FileError(path_, 0, "is damaged: a chunk has " + std::to_string(size) + " bytes");
  std::vector<std::byte> bytes(size);
  std::uint32_t filters = 0;
  checked(h5().Dread_chunk(id_.get(), H5P_DEFAULT, sizes_of(begin).data(), &filters, bytes.data()),
          path_, "cannot be read");
  if (filters != 0) throw FileError(path_, 0, "is damaged: a chunk is not compressed");
  return bytes;
}

void Hdf5Dataset::write_chunk(const Hdf5Shape& begin, const std::vector<std::byte>& bytes) {
  const auto lock = turn();
  checked(h5().Dwrite_chunk(id_.get(), H5P_DEFAULT, 0, sizes_of(begin).data(), bytes.size(),
                            bytes.data()),
          path_, "cannot be written");
}

Hdf5File::Hdf5File(const std::string& path, Mode mode) : path_(path) {
  const auto lock = turn();
  h5().Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are thrown, not printed
  if (mode == Mode::read) {
    std::error_code unknown;  // opening a pipe would wait for its other end
    if (std::filesystem::is_fifo(path, unknown)) {
      throw FileError(path, 0, "is not a reach map that can be read: it is a pipe");
    }
    id_ = {checked(h5().Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), path,
                   "is not a reach map that can be read"),
           h5().Fclose};
    return;
  }
  // The library checks this format by checksums; damaged files of the older one may crash it.
  const Hdf5Id creation(h5().Pcreate(h5().P_CLS_FILE_CREATE_ID), h5().Pclose),
      access(h5().Pcreate(h5().P_CLS_FILE_ACCESS_ID), h5().Pclose);
  h5().Pset_obj_track_times(creation.get(), false);  // files with equal content are equal
  h5().Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110);
  id_ = {checked(h5().Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), path,
                 "cannot be written"),
         h5().Fclose};
}

// Of fixed length: the library follows the references of others without checking them.
void Hdf5File::write_text(const char* attribute, const std::string& text) {
  const auto lock = turn();
  const Hdf5Id type(h5().Tcopy(h5().T_C_S1), h5().Tclose),
      space(h5().Screate(H5S_SCALAR), h5().Sclose);
  h5().Tset_size(type.get(), std::max<std::size_t>(1, text.size()));
  h5().Tset_strpad(type.get(), H5T_STR_NULLPAD);
  h5().Tset_cset(type.get(), H5T_CSET_UTF8);
  const Hdf5Id id(
      h5().Acreate2(id_.get(), attribute, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
      h5().Aclose);
  checked(id.get() < 0 ? -1 : h5().Awrite(id.get(), type.get(), text.c_str()), path_,
          "cannot be written");
}

void Hdf5File::write_numbers(const char* attribute, const std::vector<double>& numbers) {
  const auto lock = turn();
  const Hdf5Id space = numbers.size() == 1 ? Hdf5Id(h5().Screate(H5S_SCALAR), h5().Sclose)
                                           : space_of({numbers.size()});
  const Hdf5Id id(
      h5().Acreate2(id_.get(), attribute, h5().T_IEEE_F64LE, space.get(), H5P_DEFAULT, H5P_DEFAULT),
      h5().Aclose);
  checked(id.get() < 0 ? -1 : h5().Awrite(id.get(), h5().T_NATIVE_DOUBLE, numbers.data()), path_,
          "cannot be written");
}

std::string Hdf5File::read_text(const char* attribute) const {
  const auto lock = turn();
  const std::string without = std::string("is no reach map: it has no text ") + attribute;
  const Hdf5Id id(checked(h5().Aopen(id_.get(), attribute, H5P_DEFAULT), path_, without),
                  h5().Aclose);
  const Hdf5Id type(h5().Aget_type(id.get()), h5().Tclose),
      space(h5().Aget_space(id.get()), h5().Sclose);
  constexpr std::size_t most = std::size_t{64} << 20;
  const std::size_t size = h5().Tget_size(type.get());
  if (h5().Tget_class(type.get()) != H5T_STRING || h5().Tis_variable_str(type.get()) != 0 ||
      size > most || h5().Sget_simple_extent_npoints(space.get()) != 1) {
    throw FileError(path_, 0, without);
  }
  std::string text(size, '\0');
  checked(h5().Aread(id.get(), type.get(), text.data()), path_, without);
  return text.substr(0, text.find('\0'));
}

std::vector<double> Hdf5File::read_numbers(const char* attribute, std::size_t count) const {
  const auto lock = turn();
  const std::string without =
      std::string("is no reach map: it has no ") + std::to_string(count) + " numbers " + attribute;
  const Hdf5Id id(checked(h5().Aopen(id_.get(), attribute, H5P_DEFAULT), path_, without),
                  h5().Aclose);
  const Hdf5Id space(h5().Aget_space(id.get()), h5().Sclose);
  if (h5().Sget_simple_extent_npoints(space.get()) != static_cast<hssize_t>(count)) {
    throw FileError(path_, 0, without);
  }
  std::vector<double> numbers(count);
  checked(h5().Aread(id.get(), h5().T_NATIVE_DOUBLE, numbers.data()), path_, without);
  return numbers;
}

Hdf5Dataset Hdf5File::create(const char* name, Hdf5Type type, const Hdf5Shape& shape,
                             const Hdf5Shape& chunk) {
  const auto lock = turn();
  const Hdf5Id properties(h5().Pcreate(h5().P_CLS_DATASET_CREATE_ID), h5().Pclose),
      space = space_of(shape);
  if (!chunk.empty()) {
    constexpr unsigned deflate = 4;
    h5().Pset_chunk(properties.get(), static_cast<int>(chunk.size()), sizes_of(chunk).data());
    h5().Pset_shuffle(properties.get());
    h5().Pset_deflate(properties.get(), deflate);
    h5().Pset_fletcher32(properties.get());  // damage is noticed when it is read
  }
  if (type != Hdf5Type::uint8) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    h5().Pset_fill_value(properties.get(), h5().T_NATIVE_DOUBLE, &unknown);
  }
  h5().Pset_obj_track_times(properties.get(), false);
  return {Hdf5Id(checked(h5().Dcreate2(id_.get(), name, stored(type), space.get(), H5P_DEFAULT,
                                       properties.get(), H5P_DEFAULT),
                         path_, "cannot be written"),
                 h5().Dclose),
          path_};
}

Hdf5Dataset Hdf5File::open(const char* name, Hdf5Type type, const Hdf5Shape& shape,
                           const Hdf5Shape& chunk) const {
  const auto lock = turn();
  Hdf5Id id(checked(h5().Dopen2(id_.get(), name, H5P_DEFAULT), path_,
                    std::string("is no reach map: it has no dataset ") + name),
            h5().Dclose);
  const Hdf5Id space(h5().Dget_space(id.get()), h5().Sclose),
      stored_type(h5().Dget_type(id.get()), h5().Tclose),
      properties(h5().Dget_create_plist(id.get()), h5().Pclose);
  if (h5().Tequal(stored_type.get(), stored(type)) <= 0 || shape_of(space.get()) != shape ||
      chunk_of(properties.get(), shape.size()) != chunk) {
    throw FileError(path_, 0,
                    std::string("is no reach map: its dataset ") + name +
                        " has not the type, shape and chunks of its grid");
  }
  return {std::move(id), path_};
}

void Hdf5File::close() {
  const auto lock = turn();
  checked(h5().Fflush(id_.get(), H5F_SCOPE_GLOBAL), path_, "cannot be written");
  checked(id_.reset(), path_, "cannot be written");
}

}  // namespace beeline::internal
