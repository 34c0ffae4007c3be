#pragma once

#include <string>
#include <string_view>

namespace beeline::internal {

/// The decimal marks of the numbers of a table.
struct DecimalMarks {
  bool points = false, commas = false;
};

/// The ends of errors for texts beside the numbers of a row.
inline constexpr const char* comment_apart = "; write a comment in a line of its own";
inline constexpr const char* no_brackets = "; write rows of numbers without brackets or words";

/// Whether a comment may stand behind the numbers of a row.
bool has_comment(std::string_view row);

/// Returns the text with the minus of Unicode replaced by the one of ASCII.
std::string with_plain_minus(std::string_view text);

/// Returns the number of an item, which may have a sign +, the minus of Unicode and, unless commas
/// separate, a decimal comma; adds its mark. Throws Error.
double csv_number(std::string item, const std::string& column, char separator, DecimalMarks& marks);

}  // namespace beeline::internal
