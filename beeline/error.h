#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace beeline {

/// Bad input. The message names the culprit, where it stands and what would do instead. It is one
/// line, whatever stands in the names that it quotes: control characters become spaces.
/// An answer that is "no" is never an Error: results carry a status and a reason for that.
class Error : public std::runtime_error {
 public:
  explicit Error(std::string message);
};

/// Bad input that stands in a file: the message begins with `path:line: `, or with `path: ` where
/// no line can be told (line 0).
class FileError : public Error {
 public:
  FileError(std::string_view path, int line, std::string_view message);
};

/// The error for a name that is not among `choices`: names the nearest choice, then lists them all.
Error unknown_name(std::string_view what, std::string_view name,
                   const std::vector<std::string>& choices);

/// `choices` as one phrase: `a, b, c`; long lists are cut with the count of what is left out.
std::string listed(const std::vector<std::string>& choices);

/// A number for a message: six significant digits, shortest form, independent of the locale.
std::string number(double value);

/// An angle for a message, in both units: `1.5708 rad (90 deg)`.
std::string angle(double radians);

}  // namespace beeline
