#pragma once

#include <span>
#include <vector>

#include <beeline/model/arm.h>

namespace beeline {

/// The tool's pose in the world at configuration q: base * T_1(q_1) ... T_n(q_n) * tool, the
/// chapter's eq. 1.1. Any finite q, also outside limits. Throws Error when q does not fit the arm.
Pose forward_kinematics(const Arm& arm, const ConfigurationRef& q);

/// The pose of every link in the world: link 0 (the base) to link n; n + 1 poses for n joints,
/// mimic joints counted. The tool's pose is the last one times arm.tool().
std::vector<Pose> link_poses(const Arm& arm, const ConfigurationRef& q);

/// The same into the caller's buffer, which must have joints + 1 places. Does not allocate.
void link_poses(const Arm& arm, const ConfigurationRef& q, std::span<Pose> world_T_link);

}  // namespace beeline
