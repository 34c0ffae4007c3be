#include <algorithm>
#include <cmath>
#include <fmt/compile.h>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/numbers.h>

#include <fast_float/fast_float.h>

namespace beeline::internal {
namespace {

bool is_nonzero_digit(char c) { return c >= '1' && c <= '9'; }

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::from_chars_result parse_double(const char* first, const char* last, double& value) {
  const auto [end, fault] = fast_float::from_chars(first, last, value);
  if (fault != std::errc()) return {end, fault};
  // fast_float returns infinity or zero for numbers out of range.
  const bool overflow = std::isinf(value) && std::any_of(first, end, is_nonzero_digit);
  const auto* const exponent =
      std::find_if(first, end, [](char c) { return c == 'e' || c == 'E'; });
  const bool underflow = value == 0 && std::any_of(first, exponent, is_nonzero_digit);
  return {end, overflow || underflow ? std::errc::result_out_of_range : std::errc()};
}

ElementFault read_number(std::string_view text, double& value) {
  std::string_view digits = trimmed(text);
  if (digits.empty()) return ElementFault::missing_number;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  const auto [end, fault] = parse_double(digits.data(), digits.data() + digits.size(), value);
  if (fault == std::errc::invalid_argument || end != digits.data() + digits.size()) {
    return ElementFault::not_a_number;
  }
  if (fault == std::errc::result_out_of_range) return ElementFault::out_of_range;
  return std::isfinite(value) ? ElementFault::none : ElementFault::not_finite;
}

char* write_double(char* first, double value) {
  if (std::isnan(value)) return std::copy_n("nan", 3, first);  // fmt writes -nan too
  return fmt::format_to(first, FMT_COMPILE("{}"), value);
}

std::string with_point(double value) {
  std::string text = exact(value);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

std::string fixed_point(double value, int decimals) {
  return fmt::format(FMT_COMPILE("{:.{}f}"), value, decimals);
}

double rounded(double value, int digits) {
  char buffer[32];
  const char* const end = fmt::format_to(buffer, FMT_COMPILE("{:.{}e}"), value, digits - 1);
  double result = value;
  parse_double(buffer, end, result);
  return result + 0.0;
}

}  // namespace beeline::internal
