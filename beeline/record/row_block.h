#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include <beeline/error.h>

namespace beeline {

/// Where a row stands, counted from 1: row 1 is the first of numbers. A file without lines has
/// line 0.
struct RowPlace {
  std::int64_t row = 0, line = 0;
};

/// Some rows of a table: each is a column of `numbers`, of which the first `places.size()` count.
struct RowBlock {
  Eigen::MatrixXd numbers;
  std::vector<RowPlace> places;

  Eigen::Index count() const { return static_cast<Eigen::Index>(places.size()); }
};

/// What makes a row bad, with the file, the line and the row.
FileError bad_row(const std::string& path, const RowPlace& place, const std::string& message);

/// What becomes of a bad row: it ends the work, or is left out and counted.
struct BadRows {
  bool skip = false;
  std::int64_t count = 0;
  std::string first;  ///< what the first one suffers from

  void meet(const FileError& error);  ///< throws it unless bad rows are skipped
};

/// The columns that a table may have: one of several lists of names, each of another length.
using RowForms = std::vector<std::vector<std::string>>;
std::string described(const RowForms& forms);

}  // namespace beeline
