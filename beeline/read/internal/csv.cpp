#include <algorithm>
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

/// Removes the first item and its separator from `line`; returns false when it was the last item.
bool take_item(std::string_view& line, std::string& item, char separator) {
  const std::size_t start = line.find_first_not_of(" \t");
  if (start == std::string_view::npos || line[start] != '"') {
    const std::size_t end = line.find(separator);
    item = trimmed(line.substr(0, end));
    line.remove_prefix(end == std::string_view::npos ? line.size() : end + 1);
    return end != std::string_view::npos;
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
  line = trimmed(line);
  if (line.empty()) return false;
  if (line.front() != separator) throw Error(in_quotes(line) + " follows a closing quotation mark");
  line.remove_prefix(1);
  return true;
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

/// Whether the first line has numbers only, so that there is no header.
bool is_row(std::string_view line, char separator) {
  std::string item;
  bool both = false;
  for (bool more = true; more;) {
    more = take_item(line, item, separator);
    if (item.find_first_not_of("0123456789+-.eE; ") != std::string::npos) return false;
    both = both || item.find(';') != std::string::npos;
  }
  if (both)
    throw Error("commas and semicolons separate these numbers" + std::string(one_separator));
  return true;
}

/// Returns the columns of a text without a header, whose first line this is.
std::vector<std::string> columns_by_number(std::string_view line, char separator,
                                           const std::vector<std::vector<std::string>>& forms) {
  const std::size_t count = csv_items(line, separator).size();
  const auto form = std::find_if(forms.begin(), forms.end(),
                                 [count](const auto& names) { return names.size() == count; });
  if (form != forms.end()) return *form;
  throw Error("the first line must be a header of names, such as x,y,theta" +
              (forms.empty() ? std::string()
                             : "; it has " + std::to_string(count) + " numbers, which is no pose"));
}

double parse_item(const std::string& item, const std::string& column) {
  try {
    return parse_number(item, "column " + column);
  } catch (const Error& error) {
    const bool separated = item.find_first_of(",;") != std::string::npos;
    throw Error(error.what() + std::string(separated ? one_separator : ""));
  }
}

/// Removes the first item and its separator from `line` if it is a finite number without quotation
/// marks or a sign +; `more` is then whether a separator followed.
bool take_plain_number(std::string_view& line, double& value, bool& more, char separator) {
  const std::size_t end_of_item = line.find(separator);
  const std::string_view item = trimmed(line.substr(0, end_of_item));
  const auto [end, fault] = parse_double(item.data(), item.data() + item.size(), value);
  if (fault != std::errc() || end != item.data() + item.size() || !std::isfinite(value)) {
    return false;
  }
  more = end_of_item != std::string_view::npos;
  line.remove_prefix(more ? end_of_item + 1 : line.size());
  return true;
}

void parse_row(std::string_view line, const std::vector<std::string>& columns, char separator,
               std::vector<double>& row) {
  row.clear();
  std::string item;
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    double value = 0;
    if (take_plain_number(line, value, more, separator)) {
      if (count < columns.size()) row.push_back(value);
      continue;
    }
    more = take_item(line, item, separator);
    if (count < columns.size()) row.push_back(parse_item(item, columns[count]));
  }
  if (count != columns.size()) {
    throw Error("this row has " + std::to_string(count) + " items; the header has " +
                std::to_string(columns.size()));
  }
}

}  // namespace

CsvRows::CsvRows(CsvLines& lines, const std::string& path,
                 const std::vector<std::vector<std::string>>& forms)
    : lines_(lines), path_(path) {
  std::string_view first;
  if (!lines_.next(first)) throw FileError(path_, 0, "is empty; it needs a header and rows");
  if (!is_utf8(first)) throw FileError(path_, line(), "the header " + std::string(not_utf8));
  try {
    separator_ = csv_separator(first);
    has_header_ = !is_row(first, separator_);
    columns_ =
        has_header_ ? parse_header(first, separator_) : columns_by_number(first, separator_, forms);
    if (!has_header_) parse_row(first, columns_, separator_, first_row_);
  } catch (const Error& error) {
    throw FileError(path_, line(), error.what());
  }
}

bool CsvRows::next(std::vector<double>& row) {
  if (empty_ && !has_header_) {
    row = first_row_;
    empty_ = false;
    return true;
  }
  std::string_view text;
  if (!lines_.next(text)) {
    if (empty_) throw FileError(path_, 0, "has a header but no rows below it");
    return false;
  }
  try {
    parse_row(text, columns_, separator_, row);
  } catch (const Error& error) {
    throw FileError(path_, line(), error.what());
  }
  empty_ = false;
  return true;
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
  bool quoted = false, semicolon = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted) return ',';
    semicolon = semicolon || (c == ';' && !quoted);
  }
  return semicolon ? ';' : ',';
}

std::vector<std::string> csv_items(std::string_view line, char separator) {
  std::vector<std::string> items(1);
  while (take_item(line, items.back(), separator)) items.emplace_back();
  return items;
}

std::string csv_name(const std::string& name) {
  const bool plain = name.find_first_of(",;\"") == std::string::npos && trimmed(name) == name &&
                     !name.starts_with('#');
  if (plain) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + '"';
}

}  // namespace beeline::internal
