#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/comment_header.h>
#include <beeline/io/text/internal/csv_header.h>
#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_number.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

using Names = CsvForms::Names;

constexpr char date_signs[] = {':', '/', '.'};

constexpr std::size_t max_names = 10'000;  // in a header below other text

int line_number(std::int64_t count) {
  constexpr std::int64_t last = std::numeric_limits<int>::max();
  return static_cast<int>(std::min(count, last));
}

const char* past_blanks(const char* at, const char* last, char separator) {
  while (at < last && (*at == ' ' || (*at == '\t' && separator != '\t'))) ++at;
  return at;
}

enum class LineKind { text, header, row };

/// A row has only numbers, or more items than a header.
LineKind kind_of(std::string_view line, const CsvForms& forms) {
  try {
    const char separator = csv_separator(line);
    const FirstLine items = first_line(line, separator);
    if (items.all_numbers || items.all_items > max_names) return LineKind::row;
    const bool known = forms.accepts(parse_header(line, separator, forms.has_index));
    return known ? LineKind::header : LineKind::text;
  } catch (const Error&) {
    return LineKind::text;  // which may be any
  }
}

/// Removes the first item and its separator from `line` if it is a finite number without quotation
/// marks, a sign + or a decimal comma, whose digits are then `text`; `more` is whether a separator
/// followed.
bool take_plain_number(std::string_view& line, std::string_view& text, double& value, bool& more,
                       char separator) {
  const char* const last = line.data() + line.size();
  const char* const begin = past_blanks(line.data(), last, separator);
  const auto [end, fault] = parse_double(begin, last, value);
  if (fault != std::errc() || !std::isfinite(value)) return false;
  const char* next = past_blanks(end, last, separator);
  more = next != last;
  if (more && (separator == ' ' ? next == end : *next != separator)) return false;
  if (more && separator != ' ') ++next;
  text = {begin, static_cast<std::size_t>(end - begin)};
  line.remove_prefix(static_cast<std::size_t>(next - line.data()));
  return true;
}

}  // namespace

CsvRows::CsvRows(CsvLines& lines, const std::string& path, const CsvForms& forms)
    : lines_(lines), path_(path) {
  std::string_view first;
  if (!lines_.next(first)) throw FileError(path_, 0, "is empty; it needs a header and rows");
  if (!is_utf8(first))
    throw FileError(path_, line_number(lines_.number()), "the header " + not_utf8(first));
  is_framed_ = is_framed(first);
  header_line_ = line_number(lines_.number());
  comments_ = lines_.take_comments();
  try {
    read_columns(first, forms);
    if (first_row_ && lines_.row_above() > 0) {
      throw FileError(path_, line_number(lines_.row_above()),
                      "this row has no numbers; remove it, or write a header above it");
    }
    read_units();
    lines_.begin_rows();
    check_text_above(forms);
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(path_, header_line_, error.what());
  }
}

/// Decides whether the first line is a header. One of which some items are numbers is a row with a
/// mistake where rows may have as many items.
void CsvRows::read_columns(std::string_view first, const CsvForms& forms) {
  separator_ = lines_.separator().value_or(csv_separator(first));
  first = without_ends(first);
  constexpr std::string_view brackets = "[{(<";
  if (brackets.find(first.front()) != brackets.npos ||
      brackets.find(first.back()) != brackets.npos) {
    throw Error("the first line is neither a header nor a row" + std::string(no_brackets));
  }
  const FirstLine items = first_line(first, separator_);
  check_column_count(items.all_items);
  const auto is_known = [&] {
    return forms.accepts != nullptr && forms.accepts(csv_items(first, separator_));
  };
  const bool names = !items.any_number && !items.all_numbers;
  const bool known = is_known();
  if (!known && has_names_in_comment(items.count, forms)) {
    first_row_ = first;
    return;
  }
  if (!names && !known) {
    first_row_ = first;
    has_header_ = false;
    const Names* form = form_of(items.count, forms.without_header);
    if (form == nullptr) form = form_of(items.all_items, forms.without_header);
    if (form != nullptr) {
      columns_ = *form;
      for (const Comment& comment : comments_) check_comment_on_columns(comment, columns_, path_);
      return;
    }
    if (items.all_numbers) refuse_numbers(items.all_items, forms.without_header, comments_);
    has_header_ = true;
    first_row_.reset();
  }
  columns_ = parse_header(first, separator_, forms.has_index);
}

/// Throws FileError if the first line is text above a header, which is not a row of numbers.
void CsvRows::check_text_above(const CsvForms& forms) {
  if (!has_header_ || forms.accepts == nullptr || forms.reads_others) return;
  if (forms.accepts(columns_)) return;
  constexpr std::size_t most = 100;  // lines
  std::vector<CsvLines::Line> lines;
  if (first_row_) lines.push_back({*first_row_, lines_.number()});
  for (CsvLines::Line& line : lines_.look_ahead(most)) lines.push_back(std::move(line));
  for (const CsvLines::Line& line : lines) {
    const LineKind kind = kind_of(line.text, forms);
    if (kind == LineKind::row) return;
    if (kind == LineKind::text) continue;
    throw FileError(path_, header_line_,
                    "this line is not the header, as line " + std::to_string(line.number) +
                        " is; begin the lines above the header with #");
  }
}

/// Removes from a line, trimmed, what stands around its items: the frame, and semicolons at its end
/// unless they separate.
std::string_view CsvRows::without_ends(std::string_view line) const {
  if (separator_ != ';') line = without_terminators(line);
  if (separator_ != '|' || !is_framed_) return line;
  if (line.starts_with('|')) line.remove_prefix(1);
  if (line.ends_with('|')) line.remove_suffix(1);
  return line;
}

/// The header is the last comment, or the one before it if that is a row of units.
bool CsvRows::has_names_in_comment(std::size_t count, const CsvForms& forms) {
  const auto& accepts = forms.accepts_comment ? forms.accepts_comment : forms.accepts;
  if (accepts == nullptr) return false;
  const std::size_t most = std::min<std::size_t>(2, comments_.size());
  for (std::size_t back = 1; back <= most; ++back) {
    const auto comment = comments_.end() - static_cast<std::ptrdiff_t>(back);
    try {
      Names names = parse_header(comment->text, csv_separator(comment->text));
      if (names.size() == count && accepts(names)) {
        columns_ = std::move(names);
        comments_.erase(comment);
        return true;
      }
    } catch (const Error&) {
      // A comment may be any text.
    }
    Names names = words_without_units(comment->text);
    if (names.size() != count || !accepts(names)) continue;
    columns_ = std::move(names);
    return true;
  }
  return false;
}

/// Reads the first line below the header and the comments before it.
void CsvRows::read_first_row() {
  first_row_.reset();
  std::string_view next;
  if (lines_.next(next)) first_row_ = without_ends(next);
  for (Comment& comment : lines_.take_comments()) comments_.push_back(std::move(comment));
}

/// Reads the units in the row below the header, or in comments.
void CsvRows::read_units() {
  std::size_t next_to_header = comments_.size() - (comments_.empty() ? 0 : 1);
  if (has_header_ && !first_row_) read_first_row();
  if (has_header_ && first_row_ && take_units(*first_row_, separator_, &unit_fault_)) {
    read_first_row();
  }
  for (; has_header_ && next_to_header < comments_.size(); ++next_to_header) {
    const std::string& text = comments_[next_to_header].text;
    if (!take_units(text, csv_separator(text))) continue;
    comments_.erase(comments_.begin() + static_cast<std::ptrdiff_t>(next_to_header));
    break;
  }
  stated_ = stated_units(comments_, columns_, path_);
  try {
    name_units(stated_, columns_);
  } catch (const Error& error) {
    throw FileError(path_, line(), error.what());
  }
}

/// Takes the units if the line is a row of them. `fault` says why a row of units is not read.
bool CsvRows::take_units(std::string_view line, char separator, std::string* fault) {
  try {
    std::vector<std::string> items = csv_items(line, separator);
    while (items.size() > columns_.size() && items.back().empty()) items.pop_back();
    UnitRow row = with_units(columns_, items);
    if (fault != nullptr) *fault = row.fault;
    if (row.names.empty()) return false;
    columns_ = std::move(row.names);
    return true;
  } catch (const Error&) {
    return false;  // the row is refused when it is read
  }
}

void CsvRows::check_later_comments() {
  for (const Comment& comment : lines_.take_comments()) {
    const StatedUnits later = stated_units({comment}, columns_, path_);
    if (later.unread.empty() && later.is_within(stated_)) continue;
    throw FileError(path_, comment.line,
                    "the comment " + in_quotes(comment.text) +
                        " gives units below the first row; write it above the header");
  }
}

bool CsvRows::advance() {
  if (empty_ && first_row_) {
    row_ = *first_row_;
  } else if (!lines_.next(row_)) {
    check_later_comments();
    return false;
  } else {
    row_ = without_ends(row_);
  }
  empty_ = false;
  return true;
}

bool CsvRows::next(std::vector<double>& row) {
  if (!advance()) {
    if (empty_) throw FileError(path_, 0, "has a header but no rows below it");
    return false;
  }
  row.resize(columns_.size());
  try {
    parse(row.data());
  } catch (const Error& error) {
    throw FileError(path_, line(), error.what());
  }
  return true;
}

void CsvRows::parse(double* numbers) {
  if (!unit_fault_.empty()) throw Error(std::exchange(unit_fault_, {}));
  std::string_view rest = row_;
  DecimalMarks marks = marks_;
  date_.reset();
  std::size_t index = 0, count = 0;  // of items, and up to the last one that is not surplus
  for (bool more = true; more; ++index) {
    double value = 0;
    std::string_view digits;
    const bool ignored = index < ignored_.size() && ignored_[index];
    if (take_plain_number(rest, digits, value, more, separator_)) {
      count = index + 1;
      if (separator_ != ',' && !marks.points && !ignored) {
        marks.points = digits.find('.') != std::string_view::npos;
      }
    } else {
      more = take_item(rest, item_, separator_);
      if (index < columns_.size() || !item_.empty()) count = index + 1;
      if (index >= columns_.size()) continue;
      if (index == 0 && !more && columns_.size() > 1) refuse_count(1);  // perhaps all of the row
      if (!ignored) value = number_or_date(item_, index, marks);
      digits = item_;
    }
    if (index < columns_.size()) numbers[index] = value;
    for (CountedColumn& counted : counted_) {
      if (counted.column != index) continue;
      counted.item = digits;
      counted.value = value;
    }
  }
  if (count != columns_.size()) refuse_count(count);
  keep(marks);
  if (!counted_.empty()) count_all();
}

/// The number of an item that take_plain_number() refuses. A date gives 0.
double CsvRows::number_or_date(const std::string& item, std::size_t index, DecimalMarks& marks) {
  if (counted_.empty() || counted_.front().column != index) {
    return csv_number(item, columns_[index], separator_, marks);
  }
  try {
    date_ = parse_date(item);
  } catch (const Error& error) {
    throw error.behind("column " + printable(columns_[index]) + ": ");
  }
  const bool may_be_date = std::any_of(std::begin(date_signs), std::end(date_signs), [&](char c) {
    return std::count(item.begin(), item.end(), c) == 2;
  });
  if (!date_ && may_be_date) {
    throw Error("column " + printable(columns_[index]) + ": " + in_quotes(item) + not_a_date);
  }
  return date_ ? 0 : csv_number(item, columns_[index], separator_, marks);
}

void CsvRows::items(std::vector<std::string>& texts) const {
  texts.clear();
  std::string_view rest = trimmed(row_);
  std::string item;
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    more = take_item(rest, item, separator_);
    if (count < columns_.size() || !item.empty()) texts.push_back(item);
  }
  if (texts.size() != columns_.size()) refuse_count(count);
}

void CsvRows::refuse_count(std::size_t count) const {
  std::string text = "this row has " + std::to_string(count) + " items; " +
                     (has_header_ ? "the header has " + std::to_string(columns_.size())
                                  : "rows have " + form_text(columns_));
  const char other = csv_separator(row_);
  if (count == 1 && other != separator_ && item_count(row_, other) == columns_.size()) {
    text += "; write the same separator in all lines";
  } else if (has_comment(row_)) {
    text += comment_apart;
  }
  throw Error(text);
}

double CsvRows::number(const std::string& item, const std::string& column) {
  DecimalMarks marks = marks_;
  const double value = csv_number(item, column, separator_, marks);
  keep(marks);
  return value;
}

void CsvRows::keep(const DecimalMarks& marks) {
  if (marks.points && marks.commas) {
    throw Error(
        "this row has decimal commas where others have decimal points, or the reverse; write one "
        "of them throughout");
  }
  marks_ = marks;
}

void CsvRows::count_from_first(const std::vector<std::size_t>& columns) {
  for (const std::size_t column : columns) counted_.push_back({.column = column});
}

/// Throws Error for dates beside numbers, and for dates with a zone beside dates without one.
void CsvRows::count_all() {
  const std::string column = "column " + printable(columns_[counted_.front().column]);
  if (!counted_.front().first) has_dates_ = date_.has_value();
  if (has_dates_ != date_.has_value()) {
    throw Error(column + " has dates and numbers; write one of them throughout");
  }
  if (!date_) {
    for (CountedColumn& counted : counted_) counted.count();
    return;
  }
  if (zoned_.value_or(date_->has_zone) != date_->has_zone) {
    throw Error(column + " has dates with and without a zone; write one of them throughout");
  }
  zoned_ = date_->has_zone;
  counted_.front().count(date_->nanoseconds, 1e9);
}

int CsvRows::line() const { return empty_ ? header_line_ : line_number(lines_.number()); }

}  // namespace beeline::internal
