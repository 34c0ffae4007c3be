#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/internal/yaml.h>
#include <beeline/model/joint.h>

namespace beeline::internal {

/// The key of MoveIt's file below which each joint has its limits.
constexpr const char* joint_limits_key = "joint_limits";

/// Returns the members of the only key `limit` of a joint, as the files of Franka's robots have it
/// at the top level; null where it has other keys.
const Yaml::Members* urdf_limits(const YamlMember& joint);

/// Reads a member of `joint_limits`, or one with urdf_limits(): the limits of `joint`. Appends to
/// `notes` what it says that is not applied, without the joint's name. Throws FileError that names
/// the file, the line and the key.
LimitOverrides limit_overrides_from_yaml(const std::string& path, const YamlMember& member,
                                         const Joint& joint, std::vector<std::string>& notes);

}  // namespace beeline::internal
