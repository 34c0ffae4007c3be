#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_fault.h>

namespace beeline::internal {

std::string clause(ElementFault fault, std::string_view text) {
  const std::string shown = in_quotes(trimmed(text));
  switch (fault) {
    case ElementFault::empty_name:
      return "is empty";
    case ElementFault::long_name:
      return in_quotes(text) + " is longer than 1000 bytes";
    case ElementFault::not_utf8:
      return in_quotes(text) + " is not UTF-8 text";
    case ElementFault::control_character:
      return in_quotes(text) + " contains a control character";
    case ElementFault::missing_number:
      return "a number is missing";
    case ElementFault::not_a_number:
      return shown + " is not a number";
    case ElementFault::out_of_range:
      return shown + " is out of the range of numbers, 1e-308 to 1e308";
    case ElementFault::not_finite:
      return shown + " must be finite";
    case ElementFault::not_a_limit:
      return shown + " is not a limit; a limit is a number, or inf for none";
    default:
      return shown + " cannot be read";
  }
}

}  // namespace beeline::internal
