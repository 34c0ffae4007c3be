#pragma once

#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/planning/internal/self_motion.h>

namespace beeline::internal {

/// Configurations with the tool at the pose, within the bounds of `motion`, at least one on each
/// curve of self-motion. Inverse kinematics on a grid of the redundant joint, and damped least
/// squares from random configurations, find each self-motion manifold without limits. These are
/// traced and cut by the limits; between nodes that are outside, the margin is maximised.
std::vector<RedundantConfiguration> self_motion_starts(const Arm& arm, const Task& task,
                                                       const Pose& pose, SelfMotion& motion,
                                                       BudgetMeter& budget);

/// The method that takes the least time for all solutions of a few poses: numerical for an arm that
/// has a closed form only with a joint locked, which takes a tenth of a second to prepare.
InverseMethod method_for_few_poses(const Arm& arm, const Task& task);

}  // namespace beeline::internal
