#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/internal/counted_column.h>
#include <beeline/io/text/internal/csv_header.h>
#include <beeline/io/text/internal/csv_lines.h>
#include <beeline/io/text/internal/csv_number.h>
#include <beeline/io/text/internal/date.h>
#include <beeline/io/text/internal/stated_units.h>

namespace beeline::internal {

/// Properties of a table's columns besides its text.
struct CsvForms {
  using Names = CsvNames;

  /// The columns of a table without a header: the first of these that has as many as its first row
  /// has items, or the only one.
  std::vector<Names> without_header = {};
  /// Whether a table may have columns of these names; null: any names.
  std::function<bool(const Names&)> accepts = {};
  /// The same of names in a comment; null: `accepts`.
  std::function<bool(const Names&)> accepts_comment = {};
  /// Whether the name of the first of several columns may be empty, as of the index of pandas. It
  /// is index_name then.
  bool has_index = false;
  /// Whether the caller also reads tables that `accepts` refuses.
  bool reads_others = false;
};

/// The reader of all CSV texts: a table of rows below a header of names, row by row.
///
/// csv_separator() of the first line separates the items. Unless this is a comma, numbers may have
/// decimal commas, if all have them. Items may be in double quotes. Blanks around items, empty
/// items and semicolons at the end of a line, CRLF, a byte order mark, and all that CsvLines skips
/// are no data. Unless CsvForms::accepts the first line, the comment before it is the header if it
/// has as many names, also with units as in `t in s`, and CsvForms::accepts_comment them;
/// numpy.savetxt() writes such files. A row of units below the header, or a comment with as many
/// units above or below it, is appended to the names: with_units(). Other comments before the first
/// row may give units too: stated_units(). Holds some lines and comments in memory.
class CsvRows {
 public:
  using Names = CsvForms::Names;

  /// Reads the header. `path` is for messages. `lines` and `path` must outlive this object. Throws
  /// FileError for an empty text, a repeated or empty name, a header that is not UTF-8, a first row
  /// of numbers that fits no form or has a row without numbers above it, text above the header
  /// where the caller reads no other tables, and as stated_units().
  CsvRows(CsvLines& lines, const std::string& path, const CsvForms& forms = {});

  const Names& columns() const { return columns_; }
  bool has_header() const { return has_header_; }
  /// The units in the comments before the first row. The units of single columns stand
  /// behind the columns' names.
  const StatedUnits& stated() const { return stated_; }
  /// After this call, from_first(i) is the number in the i-th of these columns minus the number in
  /// the first row, exactly if both are whole numbers below 2^63: times since 1970 in nanoseconds
  /// exceed the digits of a double. The first column may have dates, parse_date(), instead of
  /// numbers: then rows have 0 and from_first(0) is in seconds.
  void count_from_first(const std::vector<std::size_t>& columns);
  double from_first(std::size_t i) const { return counted_[i].from_first; }
  const std::string& counted_item(std::size_t i) const { return counted_[i].item; }
  bool has_dates() const { return has_dates_; }  ///< known once a row has been read
  /// From now on, the items of these columns may be texts, in whose place rows have 0.
  void ignore(std::vector<bool> columns) { ignored_ = std::move(columns); }

  /// Goes to the next row; returns false at the end. Throws FileError there for comments below the
  /// first row that give other units than the comments above it.
  bool advance();
  /// Parses the row: a finite number for each column. Throws Error for another number of items, an
  /// item that is not a finite number, decimal commas beside decimal points, and a row of units
  /// with one that is not read.
  void parse(double* numbers);
  /// The items of the row as texts, one for each column. Throws Error.
  void items(std::vector<std::string>& texts) const;
  /// The number that an item of this column is. Throws Error as parse().
  double number(const std::string& item, const std::string& column);

  /// advance() and parse(). Throws FileError with the line, and for a table without rows.
  bool next(std::vector<double>& row);
  int line() const;  ///< of the row, or of the header before the first, from 1

 private:
  void read_columns(std::string_view first, const CsvForms& forms);
  std::string_view without_ends(std::string_view line) const;
  bool has_names_in_comment(std::size_t count, const CsvForms& forms);
  void check_text_above(const CsvForms& forms);
  void read_first_row();
  void read_units();
  bool take_units(std::string_view line, char separator, std::string* fault = nullptr);
  void check_later_comments();
  double number_or_date(const std::string& item, std::size_t index, DecimalMarks& marks);
  void keep(const DecimalMarks& marks);
  void count_all();
  [[noreturn]] void refuse_count(std::size_t count) const;

  CsvLines& lines_;
  const std::string& path_;
  Names columns_;
  char separator_ = ',';
  bool is_framed_ = false;  ///< lines begin and end with a pipe
  DecimalMarks marks_;      ///< of the numbers so far
  bool has_header_ = true;
  StatedUnits stated_;
  std::vector<Comment> comments_;  ///< before the first row, without the header and units of it
  int header_line_ = 0;
  std::optional<std::string> first_row_;  ///< if it has been read with the header
  std::string unit_fault_;  ///< of the first row, if it is a row of units that is not read
  std::string_view row_;
  std::string item_;   ///< of parse(), whose memory is reused
  bool empty_ = true;  ///< no row has been reached
  std::vector<bool> ignored_;
  std::vector<CountedColumn> counted_;
  bool has_dates_ = false;
  std::optional<Date> date_;   ///< of the row
  std::optional<bool> zoned_;  ///< whether the dates have a zone
};

}  // namespace beeline::internal
