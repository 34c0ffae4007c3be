#pragma once

#include <string>

namespace beeline::internal {

/// Returns the shortest digits that read back as exactly `value`, as std::to_chars() writes them.
std::string shortest_digits(double value);

/// Returns at most `precision` significant digits, without zeros at the end.
std::string rounded_digits(double value, int precision);

}  // namespace beeline::internal
