#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>

namespace beeline {

// Numbers to and from text, independent of the locale.

/// Parses a finite number such as `1`, `-2.5`, `+.5` or `3e-1`; blanks around it are allowed.
/// Throws Error, whose argument is `what`, for anything else, for nan and inf, and for numbers
/// outside the range of a double. Its message begins with `what`.
double parse_number(std::string_view text, std::string_view what);

/// Parses numbers separated by commas: `1,2,-3e-1`, also in brackets. Throws
/// the same Error, which names the item.
std::vector<double> parse_numbers(std::string_view text, std::string_view what);

/// Returns the shortest digits that read back as exactly `value`; any NaN is `nan`. Negative zero
/// is
/// `-0.0`: JSON readers take `-0` for an integer, and lose its sign.
std::string exact(double value);

}  // namespace beeline
