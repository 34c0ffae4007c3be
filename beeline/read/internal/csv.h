#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
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

/// Parses a header of names and rows of numbers, separated as csv_separator() says. Unless commas
/// separate the items, the numbers may have decimal commas. Names may be in double quotes. Blanks
/// around items, CRLF, a byte order mark, empty lines and lines that begin with # are skipped. A
/// text without a header has the columns of the first of `forms` that has as many. Throws FileError
/// for a missing header without such a form, no rows, a row of another length, a repeated column,
/// an item that is not a finite number, and decimal commas beside decimal points.
CsvTable parse_csv(std::string_view text, const std::string& path,
                   const std::vector<std::vector<std::string>>& forms = {});

/// Returns the separator of a text from its first line, by the characters outside of quotes: a
/// comma; a semicolon if there are no commas, or only those of decimal numbers; a tab if there is
/// neither; a blank, which stands for any number of them, if there are no other separators. A
/// single item has a comma.
char csv_separator(std::string_view line);

/// Reads such a table row by row.
class CsvRows {
 public:
  using Names = std::vector<std::string>;

  /// Reads the header. `path` is for messages. `lines` and `path` must outlive this object. If the
  /// first line is a row, the comment before it is the header where it has as many names and
  /// `names_columns`, unless null, accepts them, as files of numpy.savetxt() have it.
  CsvRows(CsvLines& lines, const std::string& path, const std::vector<Names>& forms = {},
          bool (*names_columns)(const Names&) = nullptr);

  const std::vector<std::string>& columns() const { return columns_; }
  bool has_header() const { return has_header_; }
  /// From now on, from_first() is the number of this column less that of the first row, exactly if
  /// both are whole numbers below 2^63: times since 1970 in nanoseconds exceed the digits of a
  /// double.
  void count_from_first(std::size_t column) { counted_ = column; }
  double from_first() const { return from_first_; }
  /// From now on, the items of these columns may be texts, in whose place rows have 0.
  void ignore(std::vector<bool> columns) { ignored_ = std::move(columns); }
  /// Gets the next row; returns false at the end.
  bool next(std::vector<double>& row);
  int line() const;  ///< of the row from next(), from 1

 private:
  /// The decimal marks of the numbers so far.
  struct DecimalMarks {
    bool points = false, commas = false;
  };

  void parse_row(std::string_view line, std::vector<double>& row);
  double number_of(std::string item, const std::string& column);
  void count(std::string_view item, double value);
  bool has_names_in(std::string_view comment, bool (*names_columns)(const Names&));

  CsvLines& lines_;
  const std::string& path_;
  std::vector<std::string> columns_;
  char separator_ = ',';
  DecimalMarks marks_;
  bool has_header_ = true;
  std::string first_row_;  ///< without a header, or below a header in a comment
  bool empty_ = true;      ///< no row has been returned
  std::vector<bool> ignored_;
  std::optional<std::size_t> counted_;
  std::optional<double> first_number_;       ///< of that column
  std::optional<std::int64_t> first_whole_;  ///< the same, if it is a whole number
  double from_first_ = 0;
};

/// Returns the items of one line without the blanks and quotes around them. Throws Error for a
/// quotation mark at the wrong position.
std::vector<std::string> csv_items(std::string_view line, char separator = ',');

/// Returns a name as a CSV header holds it: in quotes where necessary.
std::string csv_name(const std::string& name);

}  // namespace beeline::internal
