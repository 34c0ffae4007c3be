#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace beeline {

/// How the angles of a text are written; the library itself knows radians alone.
enum class AngleUnit { radians, degrees };

double to_radians(double angle, AngleUnit unit);

/// Without the blanks at both ends: space, tab, carriage return.
std::string_view trimmed(std::string_view text);

/// A finite number, as `1`, `-2.5`, `+.5`, `3e-1`, blanks around it allowed; the same in every
/// locale. Throws Error that begins with `what`: for anything else, and for nan, inf and numbers
/// too large or too small for a double.
double parse_number(std::string_view text, std::string_view what);

/// Numbers with commas between: `1,2,-3e-1`. Throws Error naming the item and its place.
std::vector<double> parse_numbers(std::string_view text, std::string_view what);

/// The shortest text that parse_number and JSON readers turn back into exactly `value`.
std::string exact(double value);

}  // namespace beeline
