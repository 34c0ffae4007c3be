#pragma once

#include <vector>

#include <beeline/inverse/inverse_kinematics.h>

namespace beeline::internal {

/// Returns configurations with the tool at a pose, the one that is reached soonest from another
/// configuration first: all for an arm without redundant joints, at most 64, and some for one with.
std::vector<Configuration> configurations_for(const Arm& arm, const Task& task, const Pose& pose,
                                              const Configuration& from, const Budget& budget);

/// Returns the one solution that inverse_kinematics() finds from a configuration with its default
/// options, or why there is none.
InverseResult solution_for(const Arm& arm, const Task& task, const Pose& pose,
                           const Configuration& from, const Budget& budget);

}  // namespace beeline::internal
