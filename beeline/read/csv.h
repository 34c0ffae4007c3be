#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace beeline {

/// Named columns of finite numbers.
struct CsvTable {
  std::string path;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  ///< each as long as `columns`; at least one
  std::vector<int> lines;                 ///< the line of the file that each row stands on
};

/// A header of names, then rows of numbers, with commas between. Blanks around items, CRLF, a byte
/// order mark, empty lines and lines that begin with # are passed over; names may stand in double
/// quotes. Throws FileError for no header, no rows, a row of another length, a column named twice
/// and an item that is no finite number.
CsvTable parse_csv(std::string_view text, const std::string& path);

/// The items of one line, without blanks and quotes around them. Throws Error for a quotation mark
/// in the wrong place.
std::vector<std::string> csv_items(std::string_view line);

/// A name as a CSV header holds it: in quotes where it must be.
std::string csv_name(const std::string& name);

}  // namespace beeline
