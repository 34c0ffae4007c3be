#pragma once

#include <vector>

#include <beeline/inverse/inverse_kinematics.h>

namespace beeline::internal {

/// Returns configurations with the tool at a pose, the one that is reached soonest from another
/// configuration first: all for an arm without redundant joints, at most 64, and some for one with.
/// Those that `blocked_by` does not block come first; if it blocks all for an arm with redundant
/// joints, they are the free ones on a finer grid, if there are any.
std::vector<Configuration> configurations_for(
    const Arm& arm, const Task& task, const Pose& pose, const Configuration& from,
    const Budget& budget, const decltype(InverseOptions::blocked_by)& blocked_by = {});

/// Returns the one solution that inverse_kinematics() finds from a configuration with its default
/// options, or why there is none.
InverseResult solution_for(const Arm& arm, const Task& task, const Pose& pose,
                           const Configuration& from, const Budget& budget);

}  // namespace beeline::internal
