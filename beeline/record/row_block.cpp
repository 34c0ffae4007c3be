#include <limits>

#include <beeline/record/row_block.h>

namespace beeline {

FileError bad_row(const std::string& path, const RowPosition& position,
                  const std::string& message) {
  const bool counted = position.line <= std::numeric_limits<int>::max();
  return {path, counted ? static_cast<int>(position.line) : 0,
          "row " + std::to_string(position.row) + ": " + message};
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
