#include "input_warning.h"

namespace beeline::python {
namespace nb = nanobind;

nb::object input_warning() {
  static PyObject* const type = PyErr_NewExceptionWithDoc(
      "beeline._core.InputWarning",
      "What a reader assumed of numbers, or what they suggest: that they are in another unit, or "
      "how a table without a header is read.",
      PyExc_UserWarning, nullptr);
  return nb::borrow(type);
}

void warn_of_input(const std::string& text) {
  nb::module_::import_("warnings").attr("warn")(input_warning()(text));
}

}  // namespace beeline::python
