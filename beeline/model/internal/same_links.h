#pragma once

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Whether the joints of both arms carry the links in the same way, from bases at the same pose.
/// Limits, names and tools may differ.
bool same_links(const Arm& a, const Arm& b);

/// The same for arms whose bases may be at different poses.
bool same_joints(const Arm& a, const Arm& b);

}  // namespace beeline::internal
