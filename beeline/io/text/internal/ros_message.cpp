#include <algorithm>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/ros_message.h>
#include <beeline/io/text/internal/ros_shapes.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {

void RosMessage::refuse(const std::string& why) const {
  throw FileError(*path_, yaml_->line, (name_.empty() ? "the message" : name_) + " " + why);
}

void RosMessage::check_keys(const std::vector<std::string>& known) const {
  const auto* members = std::get_if<Yaml::Members>(&yaml_->value);
  if (members == nullptr) refuse("must be a map of " + listed(known));
  for (const YamlMember& member : *members) {
    if (std::find(known.begin(), known.end(), member.key) != known.end()) continue;
    const Error unknown = unknown_name("key", member.key, known);
    throw FileError(*path_, member.line, (name_.empty() ? "" : name_ + ": ") + unknown.what());
  }
}

std::optional<RosMessage> RosMessage::find(std::string_view key) const {
  const auto* members = std::get_if<Yaml::Members>(&yaml_->value);
  if (members == nullptr) refuse("must be a map with " + std::string(key));
  const auto member = std::find_if(members->begin(), members->end(),
                                   [&](const YamlMember& any) { return any.key == key; });
  if (member == members->end()) return std::nullopt;
  const auto* text = std::get_if<std::string>(&member->value.value);
  const bool quoted = member->value.tag == "!";
  if (text != nullptr && !quoted && (text->empty() || *text == "null" || *text == "~")) {
    return std::nullopt;
  }
  return RosMessage(member->value, *this, (name_.empty() ? "" : name_ + ".") + std::string(key));
}

RosMessage RosMessage::need(std::string_view key) const {
  if (auto member = find(key)) return *std::move(member);
  refuse("has no " + std::string(key));
}

std::vector<RosMessage> RosMessage::items() const {
  const auto* items = std::get_if<Yaml::Items>(&yaml_->value);
  if (items == nullptr) refuse("must be a list");
  std::vector<RosMessage> values;
  for (std::size_t i = 0; i < items->size(); ++i) {
    const auto* text = std::get_if<std::string>(&(*items)[i].value);
    if (text != nullptr && *text == "...") {
      refuse("is cut off at \"...\"; ros2 topic echo --full-length writes all of it");
    }
    values.push_back(RosMessage((*items)[i], *this, name_ + "[" + std::to_string(i) + "]"));
  }
  return values;
}

std::vector<RosMessage> RosMessage::items(std::string_view key) const {
  const std::optional<RosMessage> list = find(key);
  return list ? list->items() : std::vector<RosMessage>();
}

const std::string& RosMessage::text() const {
  const auto* text = std::get_if<std::string>(&yaml_->value);
  if (text == nullptr) refuse("must be a text");
  return *text;
}

double RosMessage::number() const {
  const auto* text = std::get_if<std::string>(&yaml_->value);
  if (text == nullptr) refuse("must be a number");
  try {
    return parse_number(*text, name_);
  } catch (const Error& error) {
    throw FileError(*path_, yaml_->line, error.what());
  }
}

bool RosMessage::boolean() const {
  const std::string& given = text();
  if (given == "true" || given == "True" || given == "1") return true;
  if (given == "false" || given == "False" || given == "0") return false;
  refuse("must be true or false, not " + in_quotes(given));
}

std::vector<double> RosMessage::numbers() const {
  std::vector<double> values;
  for (const RosMessage& item : items()) values.push_back(item.number());
  return values;
}

std::vector<double> RosMessage::numbers(const std::vector<std::string>& keys) const {
  std::vector<double> values;
  if (std::holds_alternative<Yaml::Members>(yaml_->value)) {
    for (const std::string& key : keys) values.push_back(need(key).number());
  } else {
    values = numbers();
  }
  if (values.size() != keys.size()) {
    refuse("has " + std::to_string(values.size()) + " numbers; it must have " +
           std::to_string(keys.size()) + ": " + listed(keys));
  }
  return values;
}

Vector3 RosMessage::vector() const {
  const std::vector<double> values = numbers({"x", "y", "z"});
  return {values[0], values[1], values[2]};
}

Pose RosMessage::pose(std::string_view position, std::string_view orientation) const {
  check_keys({std::string(position), std::string(orientation)});
  const auto point = find(position), quaternion = find(orientation);
  const std::vector<double> q =
      quaternion ? quaternion->numbers({"x", "y", "z", "w"}) : std::vector<double>{0, 0, 0, 1};
  const Vector3 place = point ? point->vector() : Vector3::Zero();
  try {
    return ros_pose(place, {q[0], q[1], q[2], q[3]});
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    (quaternion ? *quaternion : *this).refuse(std::string("is not a rotation: ") + error.what());
  }
}

}  // namespace beeline::internal
