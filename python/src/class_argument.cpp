#include "class_argument.h"

#include <functional>
#include <map>
#include <string>

#include <beeline/model/catalog.h>

#include "value.h"

namespace beeline::python {
namespace {

std::string name_of(nb::handle type) { return nb::str(type.attr("__name__")).c_str(); }

/// How to get an object of the class from the value; empty if that is not known.
std::string cure(const std::string& type, nb::handle value) {
  if (type == "Trajectory" && nb::hasattr(value, "trajectory")) return "; take its trajectory";
  if (type != "Arm") return "";
  if (!nb::isinstance<nb::str>(value)) return "; beeline.arms.panda() makes one";
  return "; beeline.Arm.load(" + std::string(nb::repr(value).c_str()) + ") makes one";
}

}  // namespace

const Arm* arm_of(nb::handle value) {
  const Arm* arm = nullptr;
  if (!nb::isinstance<nb::str>(value)) return nb::try_cast<const Arm*>(value, arm) ? arm : nullptr;
  // Never destroyed: another thread may use an arm while the process ends.
  static auto& kept = *new std::map<std::string, Arm, std::less<>>;
  const std::string name = Value<std::string>::from(value, "arm");
  const auto found = kept.find(name);
  if (found != kept.end()) return &found->second;
  if (name.find_first_of("./\\:") != std::string::npos) return nullptr;
  return &kept.emplace(name, built_in(name)).first->second;
}

void raise_class(const char* name, nb::handle type, nb::handle value) {
  const std::string expected = name_of(type);
  const bool vowel = std::string("AEIOU").find(expected.front()) != std::string::npos;
  const std::string message =
      std::string(name) + ": expected " + (vowel ? "an " : "a ") + expected + ", not " +
      (value.is_none() ? "None" : name_of(value.type())) + cure(expected, value);
  throw nb::type_error(message.c_str());
}

}  // namespace beeline::python
