#include <algorithm>
#include <limits>
#include <string>

#include <beeline/read/internal/limit_numbers.h>
#include <beeline/read/internal/numbers.h>

namespace beeline::internal {

double parse_limit(std::string_view text, std::string_view what) {
  std::string_view digits = trimmed(text);
  const bool negative = digits.starts_with('-');
  if (negative || digits.starts_with('+')) digits.remove_prefix(1);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::string lower(digits.substr(0, 16));
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  bool infinite = lower == "inf" || lower == "infinity" || lower == ".inf";
  if (!infinite) {
    double value = 0;
    const char* const last = digits.data() + digits.size();
    const auto [end, fault] = parse_double(digits.data(), last, value);
    infinite = fault == std::errc::result_out_of_range && end == last && std::isinf(value) &&
               !digits.starts_with('-');
  }
  if (infinite) return negative ? -infinity : infinity;
  return parse_number(text, what);
}

}  // namespace beeline::internal
