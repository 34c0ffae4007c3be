#include "record.h"

namespace beeline::python {

std::string field_text(nb::handle value) {
  if (nb::hasattr(value, "dtype") && nb::cast<std::size_t>(value.attr("size")) > 16) {
    std::string text = nb::str(value.attr("shape")).c_str();
    return "<" + std::string(nb::str(value.attr("dtype")).c_str()) + " array of shape " + text +
           ">";
  }
  std::string text = nb::repr(value).c_str();
  for (std::size_t end; (end = text.find('\n')) != std::string::npos;) {
    const std::size_t next = text.find_first_not_of(' ', end + 1);
    text.replace(end, (next == std::string::npos ? text.size() : next) - end, " ");
  }
  return text;
}

}  // namespace beeline::python
