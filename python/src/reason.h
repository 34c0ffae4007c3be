#pragma once

#include <beeline/reason.h>

#include "value.h"

namespace beeline::python {

/// A str of the class Reason of the package: the sentence, with `code`, `fields` and `details`.
template <>
struct Value<Reason> {
  static std::string type() { return "Reason"; }
  static nb::object to(const Reason& reason);
  static Reason from(nb::handle value, const char* name);
  static bool same(const Reason& a, const Reason& b) { return a == b; }
};

}  // namespace beeline::python
