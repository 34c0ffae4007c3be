#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/internal/comment.h>

namespace beeline::internal {

/// Names of the columns of a table.
using CsvNames = std::vector<std::string>;

/// The name that pandas gives to an index without a name when it reads it.
inline constexpr const char* index_name = "Unnamed: 0";

/// Throws Error for more columns than a table may have, which bounds the memory of a header.
void check_column_count(std::size_t count);

std::size_t item_count(std::string_view line, char separator);

/// Returns the names in a header, without empty ones at its end. The first of several may be empty
/// if the table may have an index, and is index_name then. Throws Error for any other empty name,
/// and for a repeated one.
CsvNames parse_header(std::string_view line, char separator, bool has_index = false);

/// The kind of a first line: a row has only numbers, a header has none.
struct FirstLine {
  std::size_t all_items = 0;
  std::size_t count = 0;    ///< of the items up to the last one that is not empty
  bool all_numbers = true;  ///< or what may be meant as one, or nothing
  bool any_number = false;
};

FirstLine first_line(std::string_view line, char separator);

/// Returns the form of rows of so many items, or the only one; null if there is none.
const CsvNames* form_of(std::size_t count, const std::vector<CsvNames>& forms);

/// Returns `3 (x, y, theta)`, the names in the middle left out if there are many.
std::string form_text(const CsvNames& form);

/// Throws Error for a first row of so many numbers, which fits no form. A comment with as many
/// words may be meant as a header.
[[noreturn]] void refuse_numbers(std::size_t count, const std::vector<CsvNames>& forms,
                                 const std::vector<Comment>& comments);

}  // namespace beeline::internal
