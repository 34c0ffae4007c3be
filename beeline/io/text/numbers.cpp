#include <cmath>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_fault.h>
#include <beeline/io/text/numbers.h>

namespace beeline {

double parse_number(std::string_view text, std::string_view what) {
  double value = 0;
  const ElementFault fault = internal::read_number(text, value);
  if (fault != ElementFault::none) throw Error("", what, ": " + internal::clause(fault, text));
  return value;
}

std::vector<double> parse_numbers(std::string_view text, std::string_view what) {
  std::vector<double> values;
  if (text.size() > 1 && text.front() == '[' && text.back() == ']') {
    text = text.substr(1, text.size() - 2);
  }
  for (;;) {
    const std::size_t comma = text.find(',');
    const std::string_view item = text.substr(0, comma);
    double& value = values.emplace_back(0);
    if (const ElementFault fault = internal::read_number(item, value);
        fault != ElementFault::none) {
      throw Error("", what,
                  ": item " + std::to_string(values.size()) + ": " + internal::clause(fault, item));
    }
    if (comma == std::string_view::npos) return values;
    text.remove_prefix(comma + 1);
  }
}

std::string exact(double value) {
  if (value == 0) return std::signbit(value) ? "-0.0" : "0";
  char buffer[internal::max_number_length];
  return {buffer, internal::write_double(buffer, value)};
}

}  // namespace beeline
