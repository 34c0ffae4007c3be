#include <charconv>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/read/name.h>
#include <beeline/read/numbers.h>

namespace beeline {

double to_radians(double angle, AngleUnit unit) {
  return unit == AngleUnit::degrees ? angle * std::numbers::pi / 180 : angle;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

double parse_number(std::string_view text, std::string_view what) {
  std::string_view digits = trimmed(text);
  const auto refuse = [&](const char* why) {
    throw Error(std::string(what) + ": " + in_quotes(trimmed(text)) + " " + why);
  };
  if (digits.empty()) throw Error(std::string(what) + ": a number is missing");
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  double value = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (fault == std::errc::invalid_argument || end != digits.data() + digits.size()) {
    refuse("is not a number");
  }
  if (fault == std::errc::result_out_of_range) refuse("is out of the range of numbers, 1e+-308");
  if (!std::isfinite(value)) refuse("must be finite");
  return value;
}

std::vector<double> parse_numbers(std::string_view text, std::string_view what) {
  std::vector<double> values;
  for (;;) {
    const std::size_t comma = text.find(',');
    const std::string place = std::string(what) + ": item " + std::to_string(values.size() + 1);
    values.push_back(parse_number(text.substr(0, comma), place));
    if (comma == std::string_view::npos) return values;
    text.remove_prefix(comma + 1);
  }
}

std::string exact(double value) {
  // "-0" would be an integer to JSON readers, and lose its sign.
  if (value == 0) return std::signbit(value) ? "-0.0" : "0";
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

}  // namespace beeline
