#pragma once

#include <string>

#include <nanobind/nanobind.h>

namespace beeline::python {

/// Makes a category of warnings, `beeline._core.NAME`, a subclass of UserWarning with this
/// docstring. Keep the result: each call makes another one.
PyObject* new_warning_category(const std::string& name, const char* docstring);

/// Issues a warning: an instance of a category.
void issue_warning(nanobind::handle warning);

/// The category of warnings about units and forms of input, InputWarning.
nanobind::object input_warning();

/// Issues an InputWarning with this text.
void warn_of_input(const std::string& text);

}  // namespace beeline::python
