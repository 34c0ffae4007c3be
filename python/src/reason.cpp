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

ReasonValue value_from(ReasonField field, nb::handle value) {
  const char* what = "a field of a Reason";
  if (nb::isinstance<nb::bool_>(value)) return Value<bool>::from(value, what);
  if (nb::isinstance<nb::int_>(value)) return Value<std::size_t>::from(value, what);
  if (nb::isinstance<nb::float_>(value)) return Value<double>::from(value, what);
  if (!nb::isinstance<nb::str>(value)) {
    const auto p = Value<std::vector<double>>::from(value, what);
    if (p.size() != 3) raise_type(what, "a point of three numbers", value);
    return Eigen::Vector3d(p[0], p[1], p[2]);
  }
  const auto text = Value<std::string>::from(value, what);
  if (field != ReasonField::ending && field != ReasonField::search_ending) return text;
  return Value<Ending>::from(value, what);
}

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
    reason.set(field, value_from(field, field_value));
  }
  for (nb::handle detail : value.attr("details")) reason.details.push_back(from(detail, name));
  return reason;
}

}  // namespace beeline::python
