#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/file.h>

namespace beeline::internal {

/// The part of numpy's .npy format (numpy.lib.format) that tables of numbers need: 64-bit and
/// 32-bit floating-point numbers, little-endian, in row-major order.
struct NpyHeader {
  bool single = false;     ///< '<f4', otherwise '<f8'
  std::int64_t rows = 0;   ///< the first number of the shape
  Eigen::Index width = 1;  ///< numbers per row: the product of the shape's other numbers
  Eigen::Index last = 1;   ///< the last number of the shape if it has several; otherwise 1
};

/// Parses the dictionary at the front of a file. Throws Error for text that is not such a
/// dictionary, and for arrays of other types or orders, with the fix.
NpyHeader parse_npy_header(std::string_view dictionary);

/// Returns the first bytes of a file of this shape. Their number is constant, so that the number of
/// rows can be overwritten later.
std::string npy_front(const NpyHeader& header);

/// Reads rows from a file of any length. All functions throw FileError.
class NpyReader {
 public:
  /// Refuses a file that holds fewer numbers, or more bytes, than its header specifies.
  explicit NpyReader(const std::string& path);

  const NpyHeader& header() const { return header_; }
  /// Reads the next rows into the first columns of `block` (width x any number); returns their
  /// number, 0 at the end. The numbers may be NaN or infinite.
  Eigen::Index read(Eigen::Ref<Eigen::MatrixXd> block);
  const InputFile& file() const { return file_; }

 private:
  void read_header();
  void check_size() const;
  void check_end();

  InputFile file_;
  NpyHeader header_;
  std::int64_t left_ = 0;  ///< rows not yet read
  std::vector<float> singles_;
};

/// Writes rows to a file; commit() writes their number into its header.
class NpyWriter {
 public:
  /// Throws Error for a pipe or a device, FileError for errors of the system.
  NpyWriter(const std::string& path, Eigen::Index width, bool single);

  /// Each column of `block` is a row of the file.
  void write(const Eigen::Ref<const Eigen::MatrixXd>& block);
  void commit();

 private:
  OutputFile file_;
  NpyHeader header_;
  Eigen::MatrixXf singles_;
};

}  // namespace beeline::internal
