#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace beeline::internal {

/// Throws Error where the HDF5 library cannot be loaded, as all below do; before anything is
/// written.
void load_hdf5();

/// The numbers of a dataset.
enum class Hdf5Type { uint8, float32, float64 };
template <class Value>
constexpr Hdf5Type hdf5_type() {
  if (std::is_same_v<Value, float>) return Hdf5Type::float32;
  return std::is_same_v<Value, double> ? Hdf5Type::float64 : Hdf5Type::uint8;
}

/// Sizes along each axis.
using Hdf5Shape = std::vector<std::uint64_t>;

/// An identifier of the HDF5 library, released with this object.
class Hdf5Id {
 public:
  using Close = int (*)(std::int64_t);
  Hdf5Id() = default;
  Hdf5Id(std::int64_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Id() { reset(); }
  Hdf5Id(Hdf5Id&& other) noexcept { *this = std::move(other); }
  Hdf5Id& operator=(Hdf5Id&& other) noexcept;

  std::int64_t get() const { return id_; }
  /// Releases it now; negative for an error of the library.
  int reset();

 private:
  std::int64_t id_ = -1;
  Close close_ = nullptr;
};

/// Numbers in chunks, compressed.
class Hdf5Dataset {
 public:
  Hdf5Dataset(Hdf5Id id, std::string path) : id_(std::move(id)), path_(std::move(path)) {}

  /// Writes or reads the box of `size` that begins at `begin`.
  template <class Value>
  void write(const Hdf5Shape& begin, const Hdf5Shape& size, const Value* values) {
    transfer(begin, size, const_cast<Value*>(values), hdf5_type<Value>(), true);
  }
  template <class Value>
  void read(const Hdf5Shape& begin, const Hdf5Shape& size, Value* values) const {
    transfer(begin, size, values, hdf5_type<Value>(), false);
  }

  /// The chunk that begins at `begin`, compressed as it is stored.
  std::vector<std::byte> read_chunk(const Hdf5Shape& begin) const;
  void write_chunk(const Hdf5Shape& begin, const std::vector<std::byte>& bytes);

 private:
  void transfer(const Hdf5Shape& begin, const Hdf5Shape& size, void* values, Hdf5Type type,
                bool write) const;

  Hdf5Id id_;
  std::string path_;
};

/// An HDF5 file: attributes of its root, and datasets. Functions throw FileError for errors of the
/// library and if a file does not contain the requested object. Threads may read one
/// file, and write one each: calls of HDF5, which is not thread-safe, take turns.
class Hdf5File {
 public:
  enum class Mode { create, read };
  Hdf5File(const std::string& path, Mode mode);

  void write_text(const char* attribute, const std::string& text);
  void write_numbers(const char* attribute, const std::vector<double>& numbers);
  /// An attribute; a text has at most 64 MiB.
  std::string read_text(const char* attribute) const;
  /// An attribute of `count` numbers.
  std::vector<double> read_numbers(const char* attribute, std::size_t count) const;

  /// A new dataset whose numbers are NaN, or 0 for uint8, until they are written. `chunk` empty: in
  /// one piece, not compressed.
  Hdf5Dataset create(const char* name, Hdf5Type type, const Hdf5Shape& shape,
                     const Hdf5Shape& chunk = {});
  /// The dataset of that type, shape and chunks; throws FileError for another one.
  Hdf5Dataset open(const char* name, Hdf5Type type, const Hdf5Shape& shape,
                   const Hdf5Shape& chunk = {}) const;

  /// Ends writing. Throws FileError if not all could be written. All datasets must be destroyed
  /// before.
  void close();

 private:
  std::string path_;
  Hdf5Id id_;
};

}  // namespace beeline::internal
