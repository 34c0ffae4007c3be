#pragma once

#include <iosfwd>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace beeline {

/// Invalid input. The message names the culprit, its value, and the accepted range or choices. It
/// is one line: control characters in quoted names are replaced by spaces.
/// A negative answer ("unreachable") is not an Error: results carry a status and a reason for it.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message);
};

/// Invalid input in a file. The message begins with `path:line: `, or with `path: ` where the line
/// is not known (line 0).
class FileError : public Error {
 public:
  FileError(std::string_view path, int line, std::string_view message);
};

/// Returns the error for a name that is not among `choices`. Its message suggests the choice with
/// the smallest edit distance and lists all of them.
Error unknown_name(std::string_view what, std::string_view name,
                   const std::vector<std::string>& choices);

/// Returns `choices` as one phrase, `a, b, c`; after 24 of them the number of the others.
std::string listed(const std::vector<std::string>& choices);

/// Formats a number for a message: six significant digits, shortest form, independent of the
/// locale.
std::string number(double value);

/// Formats an angle for a message, in both units: `1.5708 rad (90 deg)`.
std::string angle(double radians);

/// Prints an enumerator (a status, a method, a frame) by its name().
template <class Enum>
requires std::is_enum_v<Enum> && requires(Enum value) { std::string(name(value)); }
std::ostream& operator<<(std::ostream& out, Enum value) { return out << std::string(name(value)); }

}  // namespace beeline
