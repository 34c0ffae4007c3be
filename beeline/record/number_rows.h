#pragma once

#include <string>
#include <variant>

#include <beeline/record/csv_rows.h>
#include <beeline/record/npy.h>

namespace beeline {

/// Tables of numbers that may be larger than the memory, in files: the format goes by the ending.
///   .csv   see CsvReader and CsvWriter; so is "-", the standard input or output
///   .npy   numpy's, N rows
/// Throws Error for another ending.
enum class RowFormat { csv, npy };
RowFormat row_format(const std::string& path);

/// Reads rows of finite numbers, block by block. All throw FileError.
class RowReader {
 public:
  RowReader(const std::string& path, const RowForms& forms);

  std::size_t form() const;  ///< which of the forms the file has
  /// The next rows, up to as many as `block.numbers` has columns; none at the end.
  void read(RowBlock& block, BadRows& bad);
  const InputFile& file() const;

 private:
  void read_npy(NpyReader& reader, RowBlock& block, BadRows& bad);

  std::variant<CsvReader, NpyReader> reader_;
  std::size_t npy_form_ = 0;
  RowForms forms_;
  std::int64_t row_ = 0;  ///< rows of the .npy file that were read
};

/// Writes rows, block by block; they are in their place, all of them, after put_in_place().
class RowWriter {
 public:
  /// `single`: 32-bit numbers, in .npy only. Throws Error, FileError.
  RowWriter(const std::string& path, const std::vector<std::string>& names, bool single,
            int threads);

  void write(const Eigen::Ref<const Eigen::MatrixXd>& block);
  void put_in_place();

 private:
  std::variant<CsvWriter, NpyWriter> writer_;
};

}  // namespace beeline
