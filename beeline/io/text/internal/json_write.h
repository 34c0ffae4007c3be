#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace beeline::internal {

/// Returns the text as a JSON string, in quotes. Throws Error when it is not UTF-8.
std::string json_string(std::string_view text);

/// Returns a JSON list of numbers, on one line; each reads back exactly.
std::string json_numbers(const double* values, std::size_t count);

}  // namespace beeline::internal
