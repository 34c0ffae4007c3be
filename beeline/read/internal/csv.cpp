#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/read/internal/csv.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/numbers.h>
#include <beeline/read/internal/text_encoding.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_columns = 100'000;  // bounds the memory that a header alone can take
constexpr const char* one_separator =
    "; separate them by commas or by semicolons, and write decimal points";
constexpr std::size_t max_rows = 4'000'000;  // an hour at 1 kHz

constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// The position of the first separator in `line`; npos if there is none.
std::size_t separator_in(std::string_view line, char separator) {
  return separator == ' ' ? line.find_first_of(" \t") : line.find(separator);
}

/// Removes the separator that begins at `end`, with the blanks that belong to it; returns false if
/// there is none.
bool remove_up_to(std::string_view& line, std::size_t end, char separator) {
  const bool more = end != std::string_view::npos;
  line.remove_prefix(more ? end + 1 : line.size());
  while (separator == ' ' && !line.empty() && is_blank(line.front())) line.remove_prefix(1);
  return more;
}

/// Removes the first item and its separator from `line`; returns false when it was the last item.
bool take_item(std::string_view& line, std::string& item, char separator) {
  const std::size_t start = line.find_first_not_of(separator == '\t' ? " " : " \t");
  if (start == std::string_view::npos || line[start] != '"') {
    const std::size_t end = separator_in(line, separator);
    item = trimmed(line.substr(0, end));
    return remove_up_to(line, end, separator);
  }
  item.clear();
  std::size_t at = start + 1;
  for (;; ++at) {
    if (at >= line.size()) throw Error("a quotation mark is not closed");
    if (line[at] != '"') {
      item += line[at];
    } else if (line.substr(at + 1).starts_with('"')) {
      item += line[at++];  // a doubled quotation mark is one character
    } else {
      break;
    }
  }
  line.remove_prefix(at + 1);
  if (trimmed(line).empty()) return false;
  const std::size_t next =
      separator == ' ' ? 0 : line.find_first_not_of(separator == '\t' ? " " : " \t");
  const bool separated = separator == ' ' ? is_blank(line.front()) : line[next] == separator;
  if (!separated) {
    throw Error(in_quotes(trimmed(line)) + " follows a closing quotation mark");
  }
  return remove_up_to(line, next, separator);
}

std::vector<std::string> parse_header(std::string_view line, char separator) {
  std::vector<std::string> columns;
  std::unordered_set<std::string> seen;
  std::string item;
  for (bool more = true; more;) {
    more = take_item(line, item, separator);
    check_name(item, "the name of column " + std::to_string(columns.size() + 1));
    if (!seen.insert(item).second) throw Error("column " + in_quotes(item) + " is given twice");
    columns.push_back(item);
    if (columns.size() > max_columns) {
      throw Error("there are more than " + std::to_string(max_columns) + " columns");
    }
  }
  return columns;
}

/// Whether the line is a row of numbers, and each of its commas is between two digits.
bool has_decimal_commas(std::string_view line) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (line.find_first_not_of("0123456789+-.,eE; \t\"") != std::string_view::npos) return false;
  for (std::size_t i = line.find(','); i != std::string_view::npos; i = line.find(',', i + 1)) {
    if (i == 0 || i + 1 == line.size() || !is_digit(line[i - 1]) || !is_digit(line[i + 1])) {
      return false;
    }
  }
  return true;
}

/// Whether the first line has numbers only, so that there is no header.
bool is_row(std::string_view line, char separator) {
  std::string item;
  for (bool more = true; more;) {
    more = take_item(line, item, separator);
    const char* const others = separator == ',' ? "0123456789+-.eE" : "0123456789+-.,eE";
    if (item.find_first_not_of(others) != std::string::npos) return false;
  }
  return true;
}

/// Returns the columns of a text without a header, whose first line this is.
std::vector<std::string> columns_by_number(std::string_view line, char separator,
                                           const std::vector<std::vector<std::string>>& forms) {
  const std::size_t count = csv_items(line, separator).size();
  const auto form = std::find_if(forms.begin(), forms.end(),
                                 [count](const auto& names) { return names.size() == count; });
  if (form != forms.end()) return *form;
  std::vector<std::string> counts;
  for (const auto& names : forms) counts.push_back(std::to_string(names.size()));
  throw Error("the first line must be a header of names" +
              (forms.empty()
                   ? std::string()
                   : "; it has " + std::to_string(count) +
                         " numbers, and a row without a header has one of " + listed(counts)));
}

/// Removes the first item and its separator from `line` if it is a finite number without quotation
/// marks, a sign + or a decimal comma; `more` is then whether a separator followed.
bool take_plain_number(std::string_view& line, double& value, bool& more, char separator) {
  const std::size_t end_of_item = separator_in(line, separator);
  const std::string_view item = trimmed(line.substr(0, end_of_item));
  const auto [end, fault] = parse_double(item.data(), item.data() + item.size(), value);
  if (fault != std::errc() || end != item.data() + item.size() || !std::isfinite(value)) {
    return false;
  }
  more = remove_up_to(line, end_of_item, separator);
  return true;
}

/// The whole number that the text is; none for another text.
std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

CsvRows::CsvRows(CsvLines& lines, const std::string& path, const std::vector<Names>& forms,
                 bool (*names_columns)(const Names&))
    : lines_(lines), path_(path) {
  std::string_view first;
  if (!lines_.next(first)) throw FileError(path_, 0, "is empty; it needs a header and rows");
  if (!is_utf8(first)) throw FileError(path_, line(), "the header " + not_utf8(first));
  try {
    separator_ = csv_separator(first);
    if (!is_row(first, separator_)) {
      columns_ = parse_header(first, separator_);
      return;
    }
    first_row_ = first;
    if (has_names_in(lines_.comment(), names_columns)) return;
    has_header_ = false;
    columns_ = columns_by_number(first, separator_, forms);
  } catch (const Error& error) {
    throw FileError(path_, line(), error.what());
  }
}

/// Takes the names of the comment before the first row for the columns if they fit.
bool CsvRows::has_names_in(std::string_view comment, bool (*names_columns)(const Names&)) {
  if (names_columns == nullptr || comment.empty()) return false;
  try {
    Names names = parse_header(comment, csv_separator(comment));
    if (names.size() != csv_items(first_row_, separator_).size() || !names_columns(names)) {
      return false;
    }
    columns_ = std::move(names);
    return true;
  } catch (const Error&) {
    return false;  // a comment may be any text
  }
}

bool CsvRows::next(std::vector<double>& row) {
  std::string_view text = first_row_;
  const bool has_first = empty_ && !first_row_.empty();
  if (!has_first && !lines_.next(text)) {
    if (empty_) throw FileError(path_, 0, "has a header but no rows below it");
    return false;
  }
  try {
    parse_row(text, row);
  } catch (const Error& error) {
    throw FileError(path_, line(), error.what());
  }
  empty_ = false;
  return true;
}

void CsvRows::parse_row(std::string_view line, std::vector<double>& row) {
  row.clear();
  std::string item;
  std::size_t index = 0;
  for (bool more = true; more; ++index) {
    const std::string_view before = line;
    double value = 0;
    if (take_plain_number(line, value, more, separator_)) {
      const std::string_view text = before.substr(0, before.size() - line.size());
      marks_.points = marks_.points || text.find('.') != std::string_view::npos;
      if (index == counted_) count(text.substr(0, text.find(separator_)), value);
    } else {
      more = take_item(line, item, separator_);
      if (index >= columns_.size()) continue;
      if (index < ignored_.size() && ignored_[index]) item = "0";
      value = number_of(item, columns_[index]);
      if (index == counted_) count(item, value);
    }
    if (index < columns_.size()) row.push_back(value);
  }
  if (index != columns_.size()) {
    throw Error("this row has " + std::to_string(index) + " items; the header has " +
                std::to_string(columns_.size()));
  }
  if (marks_.points && marks_.commas) {
    throw Error(
        "this row has decimal commas where others have decimal points, or the reverse; write one "
        "of them throughout");
  }
}

/// The number of an item in quotation marks, with a sign + or with a decimal comma.
double CsvRows::number_of(std::string item, const std::string& column) {
  const bool comma = separator_ != ',' && std::count(item.begin(), item.end(), ',') == 1 &&
                     item.find('.') == std::string::npos;
  if (comma) std::replace(item.begin(), item.end(), ',', '.');
  try {
    const double value = parse_number(item, "column " + column);
    marks_.commas = marks_.commas || comma;
    marks_.points = marks_.points || (!comma && item.find('.') != std::string::npos);
    return value;
  } catch (const Error& error) {
    const bool separated = item.find_first_of(",;") != std::string::npos;
    throw Error(error.what() + std::string(separated ? one_separator : ""));
  }
}

/// Sets from_first() by an item of the counted column and its number.
void CsvRows::count(std::string_view item, double value) {
  using Whole = std::numeric_limits<std::int64_t>;
  const std::optional<std::int64_t> whole = whole_number(trimmed(item));
  if (!first_number_) {
    first_number_ = value;
    first_whole_ = whole;
  }
  from_first_ = value - *first_number_;
  if (!whole || !first_whole_) return;
  const std::int64_t first = *first_whole_;
  const bool overflows = first < 0 ? *whole > Whole::max() + first : *whole < Whole::min() + first;
  if (!overflows) from_first_ = static_cast<double>(*whole - first);
}

int CsvRows::line() const {
  constexpr std::int64_t last = std::numeric_limits<int>::max();
  return static_cast<int>(std::min(lines_.number(), last));
}

CsvTable parse_csv(std::string_view text, const std::string& path,
                   const std::vector<std::vector<std::string>>& forms) {
  CsvLines lines(text, path);
  CsvRows rows(lines, path, forms);
  CsvTable table{.path = path,
                 .columns = rows.columns(),
                 .rows = {},
                 .lines = {},
                 .has_header = rows.has_header()};
  for (std::vector<double> row; rows.next(row);) {
    table.rows.push_back(row);
    table.lines.push_back(rows.line());
    if (table.rows.size() > max_rows) {
      throw FileError(path, rows.line(),
                      "there are more than " + std::to_string(max_rows) + " rows");
    }
  }
  return table;
}

char csv_separator(std::string_view line) {
  bool quoted = false, comma = false, semicolon = false, tab = false, blank = false;
  line = trimmed(line);
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    comma = comma || c == ',';
    semicolon = semicolon || c == ';';
    tab = tab || c == '\t';
    blank = blank || c == ' ';
  }
  if (comma && !has_decimal_commas(line)) return ',';
  if (semicolon) return ';';
  if (tab) return '\t';
  return blank ? ' ' : ',';
}

std::vector<std::string> csv_items(std::string_view line, char separator) {
  std::vector<std::string> items(1);
  line = trimmed(line);
  while (take_item(line, items.back(), separator)) items.emplace_back();
  return items;
}

std::string csv_name(const std::string& name) {
  const bool plain = name.find_first_of(",; \t\"") == std::string::npos && !name.starts_with('#');
  if (plain) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + '"';
}

}  // namespace beeline::internal
