#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/joint_from_json.h>
#include <beeline/io/text/internal/limits_from_yaml.h>
#include <beeline/io/text/internal/text_encoding.h>

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
  std::vector<std::string> names;
  for (const Joint& joint : arm.joints()) names.push_back(joint.name);
  document.check_keys(document.root(), names);
  JointLimits limits;
  for (const auto& [name, json] : document.members(document.root())) {
    limits.joints[name] = internal::limit_overrides_from_json(document, json);
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
