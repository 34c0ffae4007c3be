#pragma once

#include <string>
#include <string_view>

namespace beeline::python {

/// What the comment of a struct in a header, of its member or of an enumerator says, as Python's
/// docstring: python/header_texts.py makes the table. Empty if there is no comment.
std::string header_text(std::string_view type, std::string_view member);

/// The docstring of a declaration: `arm_figure`, `Player::step`. Throws std::logic_error without a
/// comment.
const char* comment(std::string_view name);

/// The text, kept for the life of the process. Throws std::logic_error for an empty one.
const char* docstring(const std::string& text, std::string_view type, std::string_view member);

}  // namespace beeline::python
