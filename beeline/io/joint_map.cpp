#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_fault.h>
#include <beeline/io/text/json.h>
#include <beeline/io/trajectory_file.h>

namespace beeline {
namespace {

/// Radians or metres per unit. Throws Error for a unit that the joint does not have.
double unit_named(const std::string& name, const Joint& joint) {
  using enum internal::Quantity;
  const bool slides = kind(joint) == JointKind::prismatic;
  return internal::unit_among(slides ? length : angle, name, "unit of joint " + joint.name).si;
}

MappedJoint joint_from_json(const JsonDocument& document, const Json& json, const Joint& joint) {
  MappedJoint mapped{.name = joint.name};
  if (const auto* text = std::get_if<std::string>(&json.value)) {
    mapped.name = *text;
    return mapped;
  }
  document.check_keys(json, {"name", "sign", "offset", "unit"});
  if (const Json* name = document.find(json, "name")) mapped.name = document.text(*name);
  if (const Json* sign = document.find(json, "sign")) {
    mapped.sign = document.number(*sign);
    if (std::abs(mapped.sign) != 1) document.refuse(*sign, "must be 1 or -1");
  }
  if (const Json* offset = document.find(json, "offset")) mapped.offset = document.number(*offset);
  if (const Json* unit = document.find(json, "unit")) {
    try {
      mapped.unit = unit_named(document.text(*unit), joint);
    } catch (const FileError&) {
      throw;
    } catch (const Error& error) {
      document.refuse(*unit, error.what());
    }
  }
  return mapped;
}

/// The first joint that has the name of one before; null if there is none.
const MappedJoint* find_repeated(const JointMap& map) {
  for (std::size_t i = 0; i < map.size(); ++i) {
    for (std::size_t before = 0; before < i; ++before) {
      if (map[before].name == map[i].name) return &map[i];
    }
  }
  return nullptr;
}

JointMap joint_map_from_file(const std::string& path, const Arm& arm) {
  const JsonDocument document(read_file(path), path);
  document.check_keys(document.root(), arm.joint_names());
  JointMap map;
  for (int k = 0; k < arm.dof(); ++k) {
    const Joint& joint = arm.joint_of(k);
    const Json* json = document.find(document.root(), joint.name);
    map.push_back(json == nullptr ? MappedJoint{.name = joint.name}
                                  : joint_from_json(document, *json, joint));
    const MappedJoint* twice = find_repeated(map);
    if (twice == nullptr) continue;
    const std::string fault = "gives " + internal::in_quotes(twice->name) + " to two joints";
    if (json != nullptr) document.refuse(*json, fault);
    throw FileError(path, 0, fault);
  }
  return map;
}

}  // namespace

MappedJoint mapped_joint(std::string_view name) {
  name = internal::trimmed(name);
  const bool minus = name.starts_with('-');
  if (minus) name.remove_prefix(1);
  const ElementFault fault = internal::name_fault(name);
  if (fault != ElementFault::none) {
    throw Error::of("joint_map", "a name of the joint map " + internal::clause(fault, name));
  }
  return {.name = std::string(name), .sign = minus ? -1.0 : 1.0};
}

JointMap read_joint_map(const std::string& text, const Arm& arm) {
  if (extension(text) == "json") return joint_map_from_file(text, arm);
  JointMap map;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    map.push_back(mapped_joint(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
  }
  if (static_cast<int>(map.size()) != arm.dof()) {
    throw Error::of("joint_map", "the joint map has " + std::to_string(map.size()) + " name" +
                                     (map.size() == 1 ? "" : "s") + ", not " +
                                     std::to_string(arm.dof()) + ", for " +
                                     listed(arm.joint_names()) +
                                     "; a file of a joint map ends in .json");
  }
  if (const MappedJoint* twice = find_repeated(map)) {
    throw Error("the ", "joint_map", " gives " + twice->name + " to two joints");
  }
  return map;
}

}  // namespace beeline
