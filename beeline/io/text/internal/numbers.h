#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <vector>

namespace beeline {
enum class ElementFault;
}

namespace beeline::internal {

// Numbers to and from text, independent of the locale. libc++ 14 and Emscripten 3.1 lack
// std::to_chars and std::from_chars of floating-point numbers: fmt and fast_float serve instead.

/// Returns `text` without the spaces, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);

/// Parses the number at the front of [first, last) as std::from_chars does: no blanks and no `+`
/// before it; `nan` and `inf` are accepted. A magnitude outside the range of a double, or one that
/// underflows to zero, gives std::errc::result_out_of_range.
std::from_chars_result parse_double(const char* first, const char* last, double& value);

/// Parses a number as parse_number(); returns why it is none, or `none`. With a fault `value` is
/// not defined.
ElementFault read_number(std::string_view text, double& value);

/// No text of write_double() is longer: `-2.2250738585072014e-308`.
constexpr std::size_t max_number_length = 24;

/// Writes the shortest digits that read back as exactly `value`, at most `max_number_length`
/// characters; any NaN is `nan`. Returns the end of the text.
char* write_double(char* first, double value);

/// Returns the text of exact() with a decimal point, `1.0e-07`. Readers of YAML 1.1, which ROS
/// uses, take `1e-07` for text.
std::string with_point(double value);

/// Returns `value` with this many digits after the decimal point.
std::string fixed_point(double value, int decimals);

/// Returns the number nearest to `value` with this many significant digits; -0 becomes 0.
double rounded(double value, int digits);

}  // namespace beeline::internal
