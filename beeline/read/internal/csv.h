#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/read/internal/csv_lines.h>

namespace beeline::internal {

/// A table with named columns of finite numbers.
struct CsvTable {
  std::string path;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< each as long as `columns`; at least one
  std::vector<int> lines;                 ///< the line of the file of each row
  bool has_header = true;                 ///< false: the columns are those of a form
};

/// Parses a header of names and rows of numbers, separated by commas, or by semicolons where the
/// first line has semicolons only. Names may be in double quotes. Blanks around items, CRLF, a byte
/// order mark, empty lines and lines that begin with # are skipped. A text without a header has the
/// columns of the first of `forms` that has as many. Throws FileError for a missing header without
/// such a form, no rows, a row of another length, a repeated column and an item that is not a
/// finite number.
CsvTable parse_csv(std::string_view text, const std::string& path,
                   const std::vector<std::vector<std::string>>& forms = {});

/// Returns the separator of a text from its first line: a semicolon if that has semicolons and no
/// commas, both outside of quotes, otherwise a comma.
char csv_separator(std::string_view line);

/// Reads such a table row by row.
class CsvRows {
 public:
  /// Reads the header. `path` is for messages. `lines` and `path` must outlive this object.
  CsvRows(CsvLines& lines, const std::string& path,
          const std::vector<std::vector<std::string>>& forms = {});

  const std::vector<std::string>& columns() const { return columns_; }
  bool has_header() const { return has_header_; }
  /// Gets the next row; returns false at the end.
  bool next(std::vector<double>& row);
  int line() const;  ///< of the row from next(), from 1

 private:
  CsvLines& lines_;
  const std::string& path_;
  std::vector<std::string> columns_;
  char separator_ = ',';
  bool has_header_ = true;
  std::vector<double> first_row_;  ///< without a header
  bool empty_ = true;              ///< no row has been returned
};

/// Returns the items of one line without the blanks and quotes around them. Throws Error for a
/// quotation mark at the wrong position.
std::vector<std::string> csv_items(std::string_view line, char separator = ',');

/// Returns a name as a CSV header holds it: in quotes where necessary.
std::string csv_name(const std::string& name);

}  // namespace beeline::internal
