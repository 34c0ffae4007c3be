#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>

namespace beeline {

namespace internal {
struct RowSource;
struct RowSink;
}  // namespace internal

/// The position of a row, counted from 1: row 1 is the first with numbers. Formats without lines
/// have line 0.
struct RowPosition {
  std::int64_t row = 0, line = 0;
};

/// Some rows of a table. Row i is column i of `numbers`; the first count() columns are valid.
struct RowBlock {
  Eigen::MatrixXd numbers;
  std::vector<RowPosition> positions;

  Eigen::Index count() const { return static_cast<Eigen::Index>(positions.size()); }
};

/// Returns the error of a bad row, which names the file, the line and the row.
FileError bad_row(const std::string& path, const RowPosition& position, const std::string& message);

/// Handling of bad rows: the first one throws, or all are skipped and counted.
struct BadRows {
  bool skip = false;
  std::int64_t count = 0;
  std::string first;  ///< message of the first bad row

  void report(const FileError& error);  ///< throws `error` unless bad rows are skipped
};

/// The columns that a table may have: one of several lists of names, each of another length.
using RowForms = std::vector<std::vector<std::string>>;

/// The unit of each number of each form, by its name: rad, deg, m or mm; empty for none.
using RowUnits = RowForms;

/// Returns the forms for a message: `a, b or c, d, e`.
std::string described(const RowForms& forms);

/// The format of a table of numbers, given by the ending of its path:
///   .csv   a header of names, which may be missing when read, then rows of numbers, in all
///          forms of CSV that read_poses() reads; also "-", the standard input or output
///   .npy   an array of numpy, of N rows
enum class RowFormat { csv, npy };

/// Throws Error for another ending. RowReader reads a file without an ending, such as a pipe, as
/// .csv; another ending is a FileError.
RowFormat row_format(const std::string& path);

/// Reads a table of any length block by block: rows of finite numbers, in the order of one of the
/// forms. The columns of a CSV file may be in any order, their names in upper or lower case, and in
/// another unit than `units` if their names, a row of units below them or a comment gives it, as in
/// recordings. Without `units` the names of columns have no units. All functions throw FileError.
class RowReader {
 public:
  RowReader(const std::string& path, const RowForms& forms, const RowUnits& units = {});
  ~RowReader();

  std::size_t form() const;  ///< index of the file's form
  bool has_header() const;   ///< false: the number of columns gives the form
  /// Units other than `units` that a comment gives, mm and deg.
  std::vector<std::string> commented_units() const;
  /// Reads the next rows, at most as many as `block.numbers` has columns; none at the end.
  void read(RowBlock& block, BadRows& bad);

  std::string path() const;                     ///< for messages: `stdin` for "-"
  std::optional<double> fraction_read() const;  ///< of the file, from 0 to 1; none for pipes

 private:
  std::unique_ptr<internal::RowSource> source_;
};

/// Writes a table block by block; the file appears at its path, complete, with commit().
class RowWriter {
 public:
  /// `single`: 32-bit numbers, for .npy only. `threads` format CSV; 0: one per processor.
  /// Throws Error, FileError.
  RowWriter(const std::string& path, const std::vector<std::string>& names, bool single,
            int threads);
  ~RowWriter();

  /// Each column of `block` is a row of the table. Numbers read back exactly.
  void write(const Eigen::Ref<const Eigen::MatrixXd>& block);
  void commit();

 private:
  std::unique_ptr<internal::RowSink> sink_;
};

}  // namespace beeline
