#include <algorithm>
#include <limits>
#include <string>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/limit_numbers.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_fault.h>

namespace beeline::internal {

ElementFault read_limit(std::string_view text, double& value) {
  std::string_view digits = trimmed(text);
  const bool negative = digits.starts_with('-');
  if (negative || digits.starts_with('+')) digits.remove_prefix(1);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::string lower = lower_case(digits.substr(0, 16));
  if (lower == "nan" || lower == ".nan") return ElementFault::not_a_limit;
  bool infinite = lower == "inf" || lower == "infinity" || lower == ".inf";
  if (!infinite) {
    const char* const last = digits.data() + digits.size();
    const auto [end, fault] = parse_double(digits.data(), last, value);
    infinite = fault == std::errc::result_out_of_range && end == last && std::isinf(value) &&
               !digits.starts_with('-');
  }
  if (!infinite) {
    const ElementFault fault = read_number(text, value);
    const bool word = !lower.empty() && lower.front() >= 'a' && lower.front() <= 'z';
    return fault == ElementFault::not_a_number && word ? ElementFault::not_a_limit : fault;
  }
  value = negative ? -infinity : infinity;
  return ElementFault::none;
}

double parse_limit(std::string_view text, std::string_view what) {
  double value = 0;
  const ElementFault fault = read_limit(text, value);
  if (fault != ElementFault::none) throw Error(std::string(what) + ": " + clause(fault, text));
  return value;
}

}  // namespace beeline::internal
