#pragma once

#include <string>

#include <nanobind/nanobind.h>

namespace beeline::python {

/// The category of warnings about units and forms of input, InputWarning.
nanobind::object input_warning();

/// Issues an InputWarning with this text.
void warn_of_input(const std::string& text);

}  // namespace beeline::python
