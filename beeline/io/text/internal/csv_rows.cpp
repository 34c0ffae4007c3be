#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

using Names = CsvForms::Names;

constexpr std::size_t max_columns = 100'000;  // bounds the memory that a header alone can take
constexpr const char* one_separator =
    "; separate them by commas or by semicolons, and write decimal points";

void check_column_count(std::size_t count) {
  if (count <= max_columns) return;
  throw Error("there are more than " + std::to_string(max_columns) + " columns");
}

std::size_t item_count(std::string_view line, char separator) {
  std::size_t count = 1;
  for (std::string item; take_item(line, item, separator);) ++count;
  return count;
}

Names parse_header(std::string_view line, char separator) {
  Names columns;
  std::unordered_set<std::string> seen;
  std::string item;
  for (bool more = true; more;) {
    more = take_item(line, item, separator);
    check_name(item, "the name of column " + std::to_string(columns.size() + 1));
    if (!seen.insert(item).second) throw Error("column " + in_quotes(item) + " is given twice");
    columns.push_back(item);
    check_column_count(columns.size());
  }
  return columns;
}

/// The kind of a first line: a row has only numbers, a header has none.
struct FirstLine {
  std::size_t count = 0;
  bool all_numbers = true;  ///< or what may be meant as one, or nothing
  bool any_number = false;
};

bool is_number(std::string text) {
  if (text.empty()) return false;
  std::replace(text.begin(), text.end(), ',', '.');
  double value = 0;
  const char* const last = text.data() + text.size();
  return parse_double(text.data() + (text.starts_with('+') ? 1 : 0), last, value).ptr == last;
}

/// Whether the text has digits, and otherwise only what may be beside them: also `1.2.3`.
bool has_only_digits(const std::string& text) {
  return text.find_first_not_of("0123456789+-.,eE") == std::string::npos &&
         text.find_first_of("0123456789") != std::string::npos;
}

FirstLine first_line(std::string_view line, char separator) {
  FirstLine found;
  std::string item;
  for (bool more = true; more; ++found.count) {
    more = take_item(line, item, separator);
    const bool number = is_number(item);
    found.any_number = found.any_number || number;
    found.all_numbers = found.all_numbers && (number || item.empty() || has_only_digits(item));
  }
  return found;
}

/// The form of rows of so many items; null if there is none.
const Names* form_of(std::size_t count, const std::vector<Names>& forms) {
  const auto form = std::find_if(forms.begin(), forms.end(),
                                 [count](const auto& names) { return names.size() == count; });
  if (form != forms.end()) return &*form;
  return forms.size() == 1 ? &forms.front() : nullptr;
}

/// `3 (x, y, theta)`, the names in the middle left out if there are many.
std::string form_text(const Names& form) {
  constexpr std::size_t most = 7;
  const bool all = form.size() <= most;
  const Names shown = all ? form : Names{form[0], form[1], "...", form.back()};
  return std::to_string(form.size()) + " (" + listed(shown) + ")";
}

[[noreturn]] void refuse_numbers(std::size_t count, const std::vector<Names>& forms) {
  std::string choices;
  std::vector<std::size_t> counts;
  for (const Names& form : forms) {
    if (std::find(counts.begin(), counts.end(), form.size()) != counts.end()) continue;
    counts.push_back(form.size());
    choices += (choices.empty() ? "" : ", ") + form_text(form);
  }
  throw Error("the first line must be a header of names" +
              (choices.empty() ? ""
                               : "; it has " + std::to_string(count) +
                                     " numbers, and a row without a header has one of " + choices));
}

int line_number(std::int64_t count) {
  constexpr std::int64_t last = std::numeric_limits<int>::max();
  return static_cast<int>(std::min(count, last));
}

const char* past_blanks(const char* at, const char* last, char separator) {
  while (at < last && (*at == ' ' || (*at == '\t' && separator != '\t'))) ++at;
  return at;
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
  header_line_ = line_number(lines_.number());
  try {
    read_columns(first, forms);
    read_units();
  } catch (const Error& error) {
    throw FileError(path_, header_line_, error.what());
  }
}

/// Decides whether the first line is a header. One of which some items are numbers is a row with a
/// mistake where rows may have as many items.
void CsvRows::read_columns(std::string_view first, const CsvForms& forms) {
  separator_ = lines_.separator().value_or(csv_separator(first));
  const FirstLine items = first_line(first, separator_);
  check_column_count(items.count);
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
    const Names* const form = form_of(items.count, forms.without_header);
    if (form != nullptr) {
      columns_ = *form;
      return;
    }
    if (items.all_numbers) refuse_numbers(items.count, forms.without_header);
    has_header_ = true;
    first_row_.clear();
  }
  columns_ = parse_header(first, separator_);
}

/// The header is the last comment, or the one before it if that is a row of units.
bool CsvRows::has_names_in_comment(std::size_t count, const CsvForms& forms) {
  const auto& accepts = forms.accepts_comment ? forms.accepts_comment : forms.accepts;
  if (accepts == nullptr) return false;
  const std::vector<std::string>& comments = lines_.comments();
  const std::size_t most = std::min<std::size_t>(2, comments.size());
  for (std::size_t back = 1; back <= most; ++back) {
    const std::string& comment = comments[comments.size() - back];
    try {
      Names names = parse_header(comment, csv_separator(comment));
      if (names.size() != count || !accepts(names)) continue;
      columns_ = std::move(names);
      header_comment_ = comments.size() - back;
      return true;
    } catch (const Error&) {
      continue;  // a comment may be any text
    }
  }
  return false;
}

/// Reads the units in the row below the header, or in comments.
void CsvRows::read_units() {
  if (has_header_ && first_row_.empty()) {
    std::string_view next;
    if (lines_.next(next)) first_row_ = next;
  }
  if (has_header_ && take_units(first_row_, separator_)) first_row_.clear();
  std::vector<std::string> comments = lines_.comments();
  if (header_comment_) {
    comments.erase(comments.begin() + static_cast<std::ptrdiff_t>(*header_comment_));
  }
  if (!comments.empty() && has_header_) {
    const std::string& last = comments.back();
    if (take_units(last, csv_separator(last))) comments.pop_back();
  }
  stated_ = stated_units(comments);
}

/// Takes the units if the line is a row of them.
bool CsvRows::take_units(std::string_view line, char separator) {
  try {
    Names names = with_units(columns_, csv_items(line, separator));
    if (names.empty()) return false;
    columns_ = std::move(names);
    return true;
  } catch (const Error&) {
    return false;  // the row is refused when it is read
  }
}

bool CsvRows::advance() {
  if (empty_ && !first_row_.empty()) {
    row_ = first_row_;
  } else if (!lines_.next(row_)) {
    return false;
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
  std::string_view rest = row_;
  DecimalMarks marks = marks_;
  date_.reset();
  std::size_t index = 0;
  for (bool more = true; more; ++index) {
    double value = 0;
    std::string_view digits;
    const bool ignored = index < ignored_.size() && ignored_[index];
    if (take_plain_number(rest, digits, value, more, separator_)) {
      if (separator_ != ',' && !marks.points && !ignored) {
        marks.points = digits.find('.') != std::string_view::npos;
      }
    } else {
      more = take_item(rest, item_, separator_);
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
  if (index != columns_.size()) refuse_count(index);
  keep(marks);
  if (!counted_.empty()) count_all();
}

/// The number of an item that take_plain_number() refuses. A date gives 0.
double CsvRows::number_or_date(const std::string& item, std::size_t index, DecimalMarks& marks) {
  if (counted_.empty() || counted_.front().column != index) {
    return number_in(item, columns_[index], marks);
  }
  try {
    date_ = parse_date(item);
  } catch (const Error& error) {
    throw error.behind("column " + printable(columns_[index]) + ": ");
  }
  return date_ ? 0 : number_in(item, columns_[index], marks);
}

void CsvRows::items(std::vector<std::string>& texts) const {
  texts.clear();
  std::string_view rest = trimmed(row_);
  std::string item;
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    more = take_item(rest, item, separator_);
    if (count < columns_.size()) texts.push_back(item);
  }
  if (count != columns_.size()) refuse_count(count);
}

void CsvRows::refuse_count(std::size_t count) const {
  std::string text = "this row has " + std::to_string(count) + " items; " +
                     (has_header_ ? "the header has " + std::to_string(columns_.size())
                                  : "rows have " + form_text(columns_));
  const char other = csv_separator(row_);
  if (count == 1 && other != separator_ && item_count(row_, other) == columns_.size()) {
    text += "; write the same separator in all lines";
  }
  throw Error(text);
}

double CsvRows::number(const std::string& item, const std::string& column) {
  DecimalMarks marks = marks_;
  const double value = number_in(item, column, marks);
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

/// The number of an item in quotation marks, with a sign + or with a decimal comma.
double CsvRows::number_in(std::string item, const std::string& column, DecimalMarks& marks) const {
  const bool comma = separator_ != ',' && std::count(item.begin(), item.end(), ',') == 1 &&
                     item.find('.') == std::string::npos;
  if (comma) std::replace(item.begin(), item.end(), ',', '.');
  try {
    const double value = parse_number(item, "column " + printable(column));
    marks.commas = marks.commas || comma;
    marks.points =
        marks.points || (separator_ != ',' && !comma && item.find('.') != std::string::npos);
    return value;
  } catch (const Error& error) {
    const bool separated = item.find_first_of(",;") != std::string::npos;
    throw Error(error.what() + std::string(separated ? one_separator : ""));
  }
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
