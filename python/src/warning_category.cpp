#include "warning_category.h"

namespace beeline::python {
namespace nb = nanobind;

PyObject* new_warning_category(const std::string& name, const char* docstring) {
  return PyErr_NewExceptionWithDoc(("beeline._core." + name).c_str(), docstring, PyExc_UserWarning,
                                   nullptr);
}

void issue_warning(nb::handle warning) { nb::module_::import_("warnings").attr("warn")(warning); }

nb::object input_warning() {
  static PyObject* const type = new_warning_category(
      "InputWarning",
      "What a reader assumed of numbers, or what they suggest: that they are in another unit, or "
      "how a table without a header is read.");
  return nb::borrow(type);
}

void warn_of_input(const std::string& text) { issue_warning(input_warning()(text)); }

}  // namespace beeline::python
