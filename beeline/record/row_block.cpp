#include <limits>

#include <beeline/record/row_block.h>

namespace beeline {

FileError bad_row(const std::string& path, const RowPlace& place, const std::string& message) {
  const bool counted = place.line <= std::numeric_limits<int>::max();
  return {path, counted ? static_cast<int>(place.line) : 0,
          "row " + std::to_string(place.row) + ": " + message};
}

void BadRows::report(const FileError& error) {
  if (!skip) throw error;
  if (count++ == 0) first = error.what();
}

std::string described(const RowForms& forms) {
  std::string text;
  for (const auto& form : forms) text += (text.empty() ? "" : " or ") + listed(form);
  return text;
}

}  // namespace beeline
