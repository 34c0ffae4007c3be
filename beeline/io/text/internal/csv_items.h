#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace beeline::internal {

/// Returns the separator of a text from its first line, by the characters outside of quotes: a
/// comma; a semicolon if there are no commas except decimal ones; a tab if there is neither; then a
/// pipe, which a framed line always has; a blank, which stands for any number of them, if there are
/// no other separators. Semicolons at the end of the line do not count beside other separators. A
/// single item has a comma.
char csv_separator(std::string_view line);

/// Whether a line begins and ends with a pipe, as in Markdown.
bool is_framed(std::string_view line);

/// Removes semicolons at the end of a line, which MATLAB and C have there.
std::string_view without_terminators(std::string_view line);

constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// Removes the first item and its separator from `line`; returns false when it was the last item.
/// The item is without the blanks and quotes around it. Throws Error for a quotation mark at the
/// wrong position.
bool take_item(std::string_view& line, std::string& item, char separator);

/// Returns the items of one line. Throws Error as take_item().
std::vector<std::string> csv_items(std::string_view line, char separator = ',');

/// Returns a name as a CSV header holds it: in quotes where necessary.
std::string csv_name(const std::string& name);

/// Returns the index in `names` of each name of `header`; none unless `header` has every name once.
/// Upper and lower case are alike, except between names that differ only in it.
std::optional<std::vector<std::size_t>> positions_of(const std::vector<std::string>& header,
                                                     const std::vector<std::string>& names);

}  // namespace beeline::internal
