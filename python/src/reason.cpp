#include "reason.h"

#include <variant>

#include "signature.h"

namespace beeline::python {
namespace {

struct PythonValue {
  nb::object operator()(Ending ending) const { return Value<std::string>::to(name(ending)); }
  nb::object operator()(const Eigen::Vector3d& p) const {
    nb::list point;
    for (const double x : p) point.append(x);
    return point;
  }
  template <class T>
  nb::object operator()(const T& value) const {
    return Value<T>::to(value);
  }
};

/// Converts a value to the type of its first argument.
struct FieldValue {
  nb::handle value;
  const char* name;

  ReasonValue operator()(const Eigen::Vector3d&) const {
    const auto p = Value<std::vector<double>>::from(value, name);
    if (p.size() != 3) raise_type(name, "a point of three numbers", value);
    return Eigen::Vector3d(p[0], p[1], p[2]);
  }
  template <class T>
  ReasonValue operator()(const T&) const {
    return Value<T>::from(value, name);
  }
};

}  // namespace

nb::object Value<Reason>::to(const Reason& reason) {
  nb::dict fields;
  for (const auto& [field, value] : reason.fields) {
    fields[Value<std::string>::to(name(field))] = std::visit(PythonValue(), value);
  }
  nb::list details;
  for (const Reason& detail : reason.details) details.append(to(detail));
  return nb::module_::import_("beeline._reason")
      .attr("Reason")(Value<std::string>::to(sentence(reason)), name(reason.code), fields, details);
}

Reason Value<Reason>::from(nb::handle value, const char* name) {
  if (!nb::hasattr(value, "code") || !nb::hasattr(value, "details")) {
    raise_type(name, "a Reason", value);
  }
  Reason reason{reason_code_named(Value<std::string>::from(value.attr("code"), "code"))};
  for (const auto& [key, field_value] : nb::dict(value.attr("fields"))) {
    const ReasonField field = reason_field_named(Value<std::string>::from(key, "a field's name"));
    const std::string field_name = beeline::name(field);
    reason.set(field,
               std::visit(FieldValue{field_value, field_name.c_str()}, default_value(field)));
  }
  for (nb::handle detail : value.attr("details")) reason.details.push_back(from(detail, name));
  return reason;
}

}  // namespace beeline::python
