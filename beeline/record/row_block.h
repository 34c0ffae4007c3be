#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include <beeline/error.h>

namespace beeline {

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

/// Returns the forms for a message: `a, b or c, d, e`.
std::string described(const RowForms& forms);

}  // namespace beeline
