#include "json_reason.h"

#include <variant>

namespace beeline::command {
namespace {

struct JsonValue {
  Json operator()(Ending ending) const { return name(ending); }
  Json operator()(const Eigen::Vector3d& point) const { return Eigen::VectorXd(point); }
  template <class Value>
  Json operator()(const Value& value) const {
    return value;
  }
};

}  // namespace

Json reason_members(const Reason& reason) {
  Json fields = Json::object();
  for (const auto& [field, value] : reason.fields) {
    fields.add(name(field), std::visit(JsonValue(), value));
  }
  Json details = Json::list();
  for (const Reason& detail : reason.details) details.append(json_reason(detail));
  if (!reason.details.empty()) fields.add("details", details);
  return {{"code", reason ? Json(name(reason.code)) : Json()}, {"fields", fields}};
}

Json json_reason(const Reason& reason) {
  Json members{{"reason", sentence(reason)}};
  members.add(reason_members(reason));
  return members;
}

}  // namespace beeline::command
