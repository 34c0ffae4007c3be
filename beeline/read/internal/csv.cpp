#include <algorithm>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/read/internal/csv.h>
#include <beeline/read/internal/csv_lines.h>
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

std::vector<double> parse_row(std::string_view line, const std::vector<std::string>& columns) {
  std::vector<double> row;
  row.reserve(columns.size());
  std::string item;
  std::size_t count = 0;
  for (bool more = true; more; ++count) {
    more = take_item(line, item);
    if (count < columns.size()) row.push_back(parse_number(item, "column " + columns[count]));
  }
  if (count != columns.size()) {
    throw Error("this row has " + std::to_string(count) + " items; the header has " +
                std::to_string(columns.size()));
  }
  return row;
}

}  // namespace

CsvTable parse_csv(std::string_view text, const std::string& path) {
  CsvTable table{.path = path, .columns = {}, .rows = {}, .lines = {}};
  CsvLines lines(text);
  std::string_view line;
  try {
    if (!lines.next(line)) throw FileError(path, 0, "is empty; it needs a header and rows");
    table.columns = parse_header(line);
    while (lines.next(line)) {
      table.rows.push_back(parse_row(line, table.columns));
      table.lines.push_back(static_cast<int>(lines.number()));
      if (table.rows.size() > max_rows) {
        throw Error("there are more than " + std::to_string(max_rows) + " rows");
      }
    }
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(path, static_cast<int>(lines.number()), error.what());
  }
  if (table.rows.empty()) throw FileError(path, 0, "has a header but no rows below it");
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
