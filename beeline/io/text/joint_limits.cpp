#include <optional>

#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/joint_from_json.h>
#include <beeline/io/text/internal/limits_from_yaml.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/model/catalog.h>

namespace beeline {
namespace {

bool is_json(std::string_view text, const std::string& path) {
  const std::string ending = extension(path);
  if (ending == "json") return true;
  if (ending == "yaml" || ending == "yml") return false;
  return internal::first_character(text) == '{';
}

JointLimits limits_from_json_text(std::string_view text, const std::string& path, const Arm& arm) {
  const JsonDocument document(text, path);
  std::vector<std::string> known;
  for (const Joint& joint : arm.joints()) known.push_back(joint.name);
  for (const auto& [name, json] : document.members(document.root())) {
    if (coordinate_called(arm, name)) known.push_back(name);
  }
  document.check_keys(document.root(), known);
  JointLimits limits;
  for (const auto& [name, json] : document.members(document.root())) {
    const std::optional<int> coordinate = coordinate_called(arm, name);
    const std::string& joint = coordinate ? arm.joint_of(*coordinate).name : name;
    if (!limits.joints.emplace(joint, internal::limit_overrides_from_json(document, json)).second) {
      document.refuse(json, "are limits of joint " + joint + ", which is given twice");
    }
  }
  return limits;
}

}  // namespace

JointLimits joint_limits_from_text(std::string_view text, const std::string& path, const Arm& arm) {
  JointLimits limits = is_json(text, path) ? limits_from_json_text(text, path, arm)
                                           : internal::limits_from_yaml(text, path, arm);
  try {
    with_limits(arm, limits.joints);
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
  return limits;
}

JointLimits read_joint_limits(const std::string& path, const Arm& arm) {
  return joint_limits_from_text(read_file(path), path, arm);
}

}  // namespace beeline
