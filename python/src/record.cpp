#include "record.h"

namespace beeline::python {

std::string field_text(nb::handle value) {
  if (nb::hasattr(value, "dtype") && nb::cast<std::size_t>(value.attr("size")) > 16) {
    const nb::str shape{nb::object(value.attr("shape"))}, type{nb::object(value.attr("dtype"))};
    return std::string("<") + type.c_str() + " array of shape " + shape.c_str() + ">";
  }
  std::string text = nb::repr(value).c_str();
  for (std::size_t end; (end = text.find('\n')) != std::string::npos;) {
    const std::size_t next = text.find_first_not_of(' ', end + 1);
    text.replace(end, (next == std::string::npos ? text.size() : next) - end, " ");
  }
  return text;
}

}  // namespace beeline::python
