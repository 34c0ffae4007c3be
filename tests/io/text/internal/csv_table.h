#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/internal/csv_rows.h>

namespace beeline::testing {

using Names = std::vector<std::string>;
using Rows = std::vector<std::vector<double>>;

struct Table {
  Names columns;
  Rows rows;
  std::vector<int> lines;
  bool has_header = true;
};

/// The table in the file a.csv with this text.
inline Table table_of(const std::string& text, const internal::CsvForms& forms = {}) {
  const std::string path = "a.csv";
  internal::CsvLines lines(text, path);
  internal::CsvRows rows(lines, path, forms);
  Table table{rows.columns(), {}, {}, rows.has_header()};
  for (std::vector<double> row; rows.next(row);) {
    table.rows.push_back(row);
    table.lines.push_back(rows.line());
  }
  return table;
}

}  // namespace beeline::testing
