#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/read/internal/csv.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/numbers.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_columns = 100'000;  // bounds the memory that a header alone can take
constexpr std::size_t max_rows = 4'000'000;   // an hour at 1 kHz

/// Removes the first item and its comma from `line`; returns false when it was the last item.
bool take_item(std::string_view& line, std::string& item) {
  const std::size_t start = line.find_first_not_of(" \t");
  if (start == std::string_view::npos || line[start] != '"') {
    const std::size_t comma = line.find(',');
    item = trimmed(line.substr(0, comma));
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
    return comma != std::string_view::npos;
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
  if (line.front() != ',') throw Error(in_quotes(line) + " follows a closing quotation mark");
  line.remove_prefix(1);
  return true;
}

std::vector<std::string> parse_header(std::string_view line) {
  std::vector<std::string> columns;
  std::unordered_set<std::string> seen;
  std::string item;
  for (bool more = true; more;) {
    more = take_item(line, item);
    check_name(item, "the name of column " + std::to_string(columns.size() + 1));
    if (!seen.insert(item).second) throw Error("column " + in_quotes(item) + " is given twice");
    columns.push_back(item);
    if (columns.size() > max_columns) {
      throw Error("there are more than " + std::to_string(max_columns) + " columns");
    }
  }
  const bool digits = std::all_of(columns.begin(), columns.end(), [](const std::string& name) {
    return name.find_first_not_of("0123456789+-.eE") == std::string::npos;
  });
  if (digits) throw Error("the first line must be a header of names, such as x,y,theta");
  return columns;
}

/// Removes the first item and its comma from `line` if it is a finite number without quotation
/// marks or a sign +; `more` is then whether a comma followed.
bool take_plain_number(std::string_view& line, double& value, bool& more) {
  const std::size_t comma = line.find(',');
  const std::string_view item = trimmed(line.substr(0, comma));
  const auto [end, fault] = parse_double(item.data(), item.data() + item.size(), value);
  if (fault != std::errc() || end != item.data() + item.size() || !std::isfinite(value)) {
    return false;
  }
  more = comma != std::string_view::npos;
  line.remove_prefix(more ? comma + 1 : line.size());
  return true;
}

void parse_row(std::string_view line, const std::vector<std::string>& columns,
               std::vector<double>& row) {
  row.clear();
  std::string item;
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    double value = 0;
    if (take_plain_number(line, value, more)) {
      if (count < columns.size()) row.push_back(value);
      continue;
    }
    more = take_item(line, item);
    if (count < columns.size()) row.push_back(parse_number(item, "column " + columns[count]));
  }
  if (count != columns.size()) {
    throw Error("this row has " + std::to_string(count) + " items; the header has " +
                std::to_string(columns.size()));
  }
}

}  // namespace

CsvRows::CsvRows(CsvLines& lines, const std::string& path) : lines_(lines), path_(path) {
  std::string_view header;
  if (!lines_.next(header)) throw FileError(path_, 0, "is empty; it needs a header and rows");
  try {
    columns_ = parse_header(header);
  } catch (const Error& error) {
    throw FileError(path_, line(), error.what());
  }
}

bool CsvRows::next(std::vector<double>& row) {
  std::string_view text;
  if (!lines_.next(text)) {
    if (empty_) throw FileError(path_, 0, "has a header but no rows below it");
    return false;
  }
  try {
    parse_row(text, columns_, row);
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

CsvTable parse_csv(std::string_view text, const std::string& path) {
  CsvLines lines(text);
  CsvRows rows(lines, path);
  CsvTable table{.path = path, .columns = rows.columns(), .rows = {}, .lines = {}};
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

std::vector<std::string> csv_items(std::string_view line) {
  std::vector<std::string> items(1);
  while (take_item(line, items.back())) items.emplace_back();
  return items;
}

std::string csv_name(const std::string& name) {
  const bool plain = name.find_first_of(",\"") == std::string::npos && trimmed(name) == name &&
                     !name.starts_with('#');
  if (plain) return name;
  std::string text = "\"";
  for (const char c : name) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + '"';
}

}  // namespace beeline::internal
