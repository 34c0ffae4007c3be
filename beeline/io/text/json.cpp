#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/error.h>
#include <beeline/io/text/internal/json_parse.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/json.h>

namespace beeline {
namespace {

const char* kind_of(const Json& json) {
  constexpr std::array<const char*, 7> kinds{"null",   "true or false", "a number", "text",
                                             "a list", "an object",     "a number"};
  return kinds[json.value.index()];
}

/// Appends the path from `from` to `target` to `value_path`, as `joints[2].limits`; returns false
/// when `target` is not below `from`.
bool find_value_path(const Json& from, const Json& target, std::string& value_path) {
  if (&from == &target) return true;
  const std::size_t length = value_path.size();
  if (const auto* items = std::get_if<Json::Items>(&from.value)) {
    for (std::size_t i = 0; i < items->size(); ++i) {
      value_path += '[' + std::to_string(i) + ']';
      if (find_value_path((*items)[i], target, value_path)) return true;
      value_path.resize(length);
    }
  } else if (const auto* members = std::get_if<Json::Members>(&from.value)) {
    for (const auto& [key, value] : *members) {
      value_path += (value_path.empty() ? "" : ".") + internal::printable(key);
      if (find_value_path(value, target, value_path)) return true;
      value_path.resize(length);
    }
  }
  return false;
}

template <typename Value>
const Value& get(const JsonDocument& document, const Json& json, const char* wanted) {
  const auto* value = std::get_if<Value>(&json.value);
  if (value == nullptr) {
    document.refuse(json, std::string("must be ") + wanted + ", not " + kind_of(json));
  }
  return *value;
}

}  // namespace

Json::Json(std::nullptr_t) {}

Json::Json(bool truth) : value(truth) {}

Json::Json(double number) {
  if (std::isfinite(number)) value = number;
}

Json::Json(const char* text) : value(std::string(text)) {}

Json::Json(std::string text) : value(std::move(text)) {}

Json::Json(const std::vector<std::string>& texts) : value(Items(texts.begin(), texts.end())) {}

Json::Json(const Eigen::VectorXd& numbers) : value(Items(numbers.begin(), numbers.end())) {}

Json::Json(std::initializer_list<Member> members) : value(Members{}) {
  for (const Member& member : members) add(member.key, member.value);
}

Json Json::object() { return Json(std::initializer_list<Member>{}); }

Json Json::list() {
  Json json;
  json.value = Items();
  return json;
}

void Json::append(Json item) {
  if (std::holds_alternative<std::nullptr_t>(value)) value = Items();
  std::get<Items>(value).push_back(std::move(item));
}

void Json::add(std::string key, Json member) {
  if (std::holds_alternative<std::nullptr_t>(value)) value = Members();
  Members& members = std::get<Members>(value);
  const auto same = std::find_if(members.begin(), members.end(),
                                 [&key](const Member& other) { return other.key == key; });
  if (same == members.end()) {
    members.push_back({std::move(key), std::move(member)});
  } else {
    same->value = std::move(member);
  }
}

void Json::add(const Json& members) {
  if (std::holds_alternative<std::nullptr_t>(members.value)) return;
  for (const auto& [key, member] : std::get<Members>(members.value)) add(key, member);
}

Json JsonDocument::parse(std::string_view text, const std::string& path) {
  return internal::parse_json(text, path);
}

JsonDocument::JsonDocument(Json root, std::string path, std::string place)
    : path_(std::move(path)), place_(std::move(place)), root_(std::move(root)) {}

std::string JsonDocument::place_of(const Json& json) const {
  std::string value_path = place_;
  find_value_path(root_, json, value_path);
  return value_path;
}

double JsonDocument::number(const Json& json) const {
  if (const auto* const whole = std::get_if<std::int64_t>(&json.value)) {
    return static_cast<double>(*whole);
  }
  return get<double>(*this, json, "a number");
}

bool JsonDocument::truth(const Json& json) const { return get<bool>(*this, json, "true or false"); }

const std::string& JsonDocument::text(const Json& json) const {
  return get<std::string>(*this, json, "text");
}

const Json::Items& JsonDocument::items(const Json& json) const {
  return get<Json::Items>(*this, json, "a list");
}

const Json::Members& JsonDocument::members(const Json& json) const {
  return get<Json::Members>(*this, json, "an object");
}

std::vector<double> JsonDocument::numbers(const Json& json, std::size_t count) const {
  const Json::Items& list = items(json);
  if (list.size() != count) {
    refuse(json, "must be a list of " + std::to_string(count) + " numbers; it has " +
                     std::to_string(list.size()));
  }
  std::vector<double> values;
  for (const Json& item : list) values.push_back(number(item));
  return values;
}

const Json* JsonDocument::find(const Json& object, std::string_view key) const {
  for (const auto& [name, value] : members(object)) {
    if (name == key) return &value;
  }
  return nullptr;
}

const Json& JsonDocument::need(const Json& object, std::string_view key) const {
  const Json* found = find(object, key);
  if (found == nullptr) refuse(object, "needs the key \"" + std::string(key) + "\"");
  return *found;
}

void JsonDocument::check_keys(const Json& object, const std::vector<std::string>& known) const {
  for (const auto& [key, value] : members(object)) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const std::string value_path = place_of(object);
    const std::string error = unknown_name("key", internal::printable(key), known).what();
    throw FileError(path_, value.line, value_path.empty() ? error : value_path + ": " + error);
  }
}

void JsonDocument::refuse(const Json& at, const std::string& message) const {
  const std::string value_path = place_of(at);
  throw FileError(path_, at.line,
                  (value_path.empty() ? "the document" : value_path) + " " + message);
}

}  // namespace beeline
