#include "json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace {

nlohmann::ordered_json converted(const Json& json) {
  using Document = nlohmann::ordered_json;
  return std::visit(
      [](const auto& value) -> Document {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, Json::List>) {
          Document list = Document::array();
          for (const Json& element : value) list.push_back(converted(element));
          return list;
        } else if constexpr (std::is_same_v<Value, Json::Object>) {
          Document object = Document::object();
          for (std::size_t i = 0; i < value.keys.size(); ++i) {
            object[value.keys[i]] = converted(value.values[i]);
          }
          return object;
        } else {
          return Document(value);
        }
      },
      json.value());
}

}  // namespace

Json::Json(double value) {
  if (std::isfinite(value)) value_ = value;
}

Json::Json(const std::vector<std::string>& texts) : value_(List(texts.begin(), texts.end())) {}

Json::Json(const Eigen::VectorXd& values) : value_(List(values.begin(), values.end())) {}

Json::Json(std::initializer_list<Member> members) : value_(Object{}) {
  for (const Member& member : members) add(member.key, member.value);
}

Json Json::object() {
  Json json;
  json.value_ = Object();
  return json;
}

Json Json::list() {
  Json json;
  json.value_ = List();
  return json;
}

void Json::append(Json element) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = List();
  std::get<List>(value_).push_back(std::move(element));
}

void Json::add(std::string key, Json value) {
  if (std::holds_alternative<std::nullptr_t>(value_)) value_ = Object();
  Object& object = std::get<Object>(value_);
  object.keys.push_back(std::move(key));
  object.values.push_back(std::move(value));
}

void Json::add(const Json& members) {
  if (std::holds_alternative<std::nullptr_t>(members.value_)) return;
  const Object& object = std::get<Object>(members.value_);
  for (std::size_t i = 0; i < object.keys.size(); ++i) add(object.keys[i], object.values[i]);
}

std::string Json::text() const {
  constexpr int indent = 2;
  return converted(*this).dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}
