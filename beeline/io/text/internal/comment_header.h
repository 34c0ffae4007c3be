#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/internal/comment.h>

namespace beeline::internal {

/// Returns the words of a comment, between blanks, commas, semicolons and pipes, without the units
/// of `t in s` and `t [s]` and without a first word such as `columns:`. They are the names of
/// columns if the comment is a header.
std::vector<std::string> words_without_units(std::string_view comment);

/// Throws FileError for a comment that speaks of other columns than a table without a
/// header: it has their names, each once, in another order, or as many words as the table has
/// columns, two of which at least are names of them, and all words are names or separated. `x and
/// y` is prose.
void check_comment_on_columns(const Comment& comment, const std::vector<std::string>& columns,
                              const std::string& path);

}  // namespace beeline::internal
