#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/internal/csv_lines.h>

namespace beeline::internal {

/// What is known of a table's columns besides its text.
struct CsvForms {
  using Names = std::vector<std::string>;

  /// The columns of a table without a header: the first of these that has as many as its first row
  /// has items, or the only one.
  std::vector<Names> without_header = {};
  /// Whether a table may have columns of these names; null: any names.
  std::function<bool(const Names&)> accepts = {};
  /// The same of names in a comment; null: `accepts`.
  std::function<bool(const Names&)> accepts_comment = {};
};

/// The reader of all CSV texts: a table of rows below a header of names, row by row.
///
/// The items are separated as csv_separator() says of the first line. Unless commas separate them,
/// numbers may have decimal commas, if all have. Items may be in double quotes. Blanks around
/// items, CRLF, a byte order mark, empty lines, and lines that begin with # or % are skipped.
/// Unless CsvForms::accepts the first line, the comment before it is the header if it has as many
/// names and CsvForms::accepts_comment them, as files of numpy.savetxt() have it. The memory is
/// that of one line.
class CsvRows {
 public:
  using Names = CsvForms::Names;

  /// Reads the header. `path` is for messages. `lines` and `path` must outlive this object. Throws
  /// FileError for an empty text, a repeated or empty name, a header that is not UTF-8, and numbers
  /// in the place of a header that no form has.
  CsvRows(CsvLines& lines, const std::string& path, const CsvForms& forms = {});

  const Names& columns() const { return columns_; }
  bool has_header() const { return has_header_; }
  /// From now on, from_first() is the number of this column less that of the first row, exactly if
  /// both are whole numbers below 2^63: times since 1970 in nanoseconds exceed the digits of a
  /// double.
  void count_from_first(std::size_t column) { counted_ = column; }
  double from_first() const { return from_first_; }
  /// From now on, the items of these columns may be texts, in whose place rows have 0.
  void ignore(std::vector<bool> columns) { ignored_ = std::move(columns); }

  /// Goes to the next row; returns false at the end.
  bool advance();
  /// Parses the row: a finite number for each column. Throws Error for another number of items, an
  /// item that is not a finite number, and decimal commas beside decimal points.
  void parse(double* numbers);
  /// The items of the row as texts, one for each column. Throws Error.
  void items(std::vector<std::string>& texts) const;
  /// The number that an item of this column is. Throws Error as parse().
  double number(const std::string& item, const std::string& column);

  /// advance() and parse(). Throws FileError with the line, and for a table without rows.
  bool next(std::vector<double>& row);
  int line() const;  ///< of the row, or of the header before the first, from 1

 private:
  /// The decimal marks of the numbers so far.
  struct DecimalMarks {
    bool points = false, commas = false;
  };

  void read_columns(std::string_view first, const CsvForms& forms);
  bool has_names_in_comment(std::size_t count, const CsvForms& forms);
  double number_in(std::string item, const std::string& column, DecimalMarks& marks) const;
  void keep(const DecimalMarks& marks);
  void count(std::string_view item, double value);
  [[noreturn]] void refuse_count(std::size_t count) const;

  CsvLines& lines_;
  const std::string& path_;
  Names columns_;
  char separator_ = ',';
  DecimalMarks marks_;
  bool has_header_ = true;
  std::string first_row_;  ///< without a header, or below a header in a comment
  std::string_view row_;
  std::string item_, counted_item_;  ///< of parse(), whose memory is reused
  bool empty_ = true;                ///< no row has been reached
  std::vector<bool> ignored_;
  std::optional<std::size_t> counted_;
  std::optional<double> first_number_;       ///< of that column
  std::optional<std::int64_t> first_whole_;  ///< the same, if it is a whole number
  double from_first_ = 0;
};

}  // namespace beeline::internal
