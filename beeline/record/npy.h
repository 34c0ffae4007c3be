#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/read/file_stream.h>

namespace beeline {

/// numpy's .npy format (numpy.lib.format), as far as tables of numbers need it: 64-bit and 32-bit
/// floats, lowest byte first, row by row.
struct NpyHeader {
  bool single = false;     ///< '<f4', else '<f8'
  std::int64_t rows = 0;   ///< the first number of the shape
  Eigen::Index width = 1;  ///< numbers in a row: the product of the shape's other numbers
};

/// The dictionary that stands at the front of a file. Throws Error for what is no such dictionary,
/// and for arrays of another kind, with what would do.
NpyHeader parse_npy_header(std::string_view dictionary);

/// The first bytes of a file of this shape, always equally many: the number of rows may be written
/// over later.
std::string npy_front(const NpyHeader& header);

/// Rows from a file that may be larger than the memory. All throw FileError.
class NpyReader {
 public:
  /// Refuses a file that holds fewer numbers, or more bytes, than its header says.
  explicit NpyReader(const std::string& path);

  const NpyHeader& header() const { return header_; }
  /// The next rows into the first columns of `block` (width x any number); returns how many. 0 at
  /// the end. The numbers may be anything, NaN too.
  Eigen::Index read(Eigen::Ref<Eigen::MatrixXd> block);
  const InputFile& file() const { return file_; }

 private:
  void read_header();
  void check_size() const;

  InputFile file_;
  NpyHeader header_;
  std::int64_t left_ = 0;
  std::vector<float> singles_;
};

/// Rows into a file whose number of rows is known when they have all been written.
class NpyWriter {
 public:
  /// Throws Error for a pipe or a device, FileError for what the system refuses.
  NpyWriter(const std::string& path, Eigen::Index width, bool single);

  /// Each column of `block` is a row of the file.
  void write(const Eigen::Ref<const Eigen::MatrixXd>& block);
  void put_in_place();

 private:
  OutputFile file_;
  NpyHeader header_;
  Eigen::MatrixXf singles_;
};

}  // namespace beeline
