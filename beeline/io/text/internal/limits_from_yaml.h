#pragma once

#include <string>
#include <string_view>

#include <beeline/io/text/arm.h>

namespace beeline::internal {

/// Parses MoveIt's joint_limits.yaml as read_joint_limits() documents. Does not check that the
/// limits are consistent with the limits of the arm that they do not replace.
JointLimits limits_from_yaml(std::string_view text, const std::string& path, const Arm& arm);

}  // namespace beeline::internal
