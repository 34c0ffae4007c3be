#pragma once

#include <cstddef>
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
  /// The error of one argument, or member of options, that the message names. The message consists
  /// of `before`, the argument's name, and `after`.
  Error(std::string_view before, std::string_view argument, std::string_view after);

  /// Returns the error of one argument that the message does not name.
  static Error of(std::string_view argument, const std::string& message);
  /// Returns the error with a text in front of its message. A FileError has its own, which keeps
  /// the file and the line: catch it before Error.
  Error behind(std::string_view text) const;

  /// Returns the name in C++ of the invalid argument, such as `max_samples`; empty: unknown.
  const std::string& argument() const { return argument_; }
  /// Returns whether the message names the argument.
  bool names_argument() const { return position_ != std::string::npos; }
  /// Returns the message for users who know the argument by another name, such as --max-samples.
  /// The other name replaces the argument's name or, if the message does not name it, precedes the
  /// message.
  std::string message_for(std::string_view name) const;

 private:
  std::string argument_;
  std::size_t position_ = std::string::npos;  ///< position of the argument's name in the message
};

/// Invalid input in a file. The message begins with `path:line: `, or with `path: ` if the line is
/// not known (line 0).
class FileError : public Error {
 public:
  FileError(std::string_view path, int line, std::string_view message);

  /// Returns the error of the same file and line with a text in front of fault().
  FileError behind(std::string_view text) const;

  const std::string& path() const { return path_; }
  int line() const { return line_; }                   ///< line number, from 1; 0: unknown
  const std::string& fault() const { return fault_; }  ///< the message without path and line

 private:
  std::string path_, fault_;
  int line_ = 0;
};

/// Returns the error for a name that is not among `choices`. Its message suggests the choice with
/// the smallest edit distance and, if `lists_choices`, lists all of them.
Error unknown_name(std::string_view what, std::string_view name,
                   const std::vector<std::string>& choices, bool lists_choices = true);

/// Returns `choices` as one phrase, `a, b, c`; after 24 of them the number of the others.
std::string listed(const std::vector<std::string>& choices);

/// Formats a number for a message: six significant digits, shortest form, independent of the
/// locale.
std::string number(double value);

/// Formats an angle for a message, in both units: `1.5708 rad (90 deg)`.
std::string angle(double radians);

/// Formats a fraction as a percentage for a message: one decimal, none from 1000 on, two
/// significant digits below 1: `63.7 %`, `100 %`, `0.02 %`.
std::string percent(double fraction);

/// Formats a fraction as percent() does, but rounded up, for an upper bound. A fraction of up to 1
/// + 1e-6 is shown as `100 %`, a larger one never.
std::string percent_at_most(double fraction);

/// Returns the least number of so many significant digits that is at least `value`: a bound that is
/// printed.
double rounded_up(double value, int digits);

/// Returns the greatest number of so many significant digits that is at most `value`.
double rounded_down(double value, int digits);

/// A number with six significant digits, rounded up: a bound that is accepted when it is typed.
std::string number_at_least(double value);

/// Formats a number with six significant digits, or with more if number(reference) looks the same.
std::string number_apart(double value, double reference);

/// Prints an enumerator (a status, a method, a frame) by its name().
template <class Enum>
requires std::is_enum_v<Enum> && requires(Enum value) { std::string(name(value)); }
std::ostream& operator<<(std::ostream& out, Enum value) { return out << std::string(name(value)); }

}  // namespace beeline
