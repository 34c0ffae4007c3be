#pragma once

#include <functional>
#include <vector>

#include <beeline/inverse/inverse_kinematics.h>

namespace beeline::internal {

/// Why a configuration must not be taken; no reason if it may be.
using BlockedBy = std::function<Reason(const ConfigurationRef&)>;

/// Returns configurations with the tool at a pose, the one that is reached soonest from another
/// configuration first: all for an arm without redundant joints, at most 64, and some for one with.
/// If `blocked_by` blocks all of these, they are the free ones on a finer grid, if there are any.
std::vector<Configuration> configurations_for(const Arm& arm, const Task& task, const Pose& pose,
                                              const Configuration& from, const Budget& budget,
                                              const BlockedBy& blocked_by = {});

/// Returns the one solution that inverse_kinematics() finds from a configuration with its default
/// options, or why there is none.
InverseResult solution_for(const Arm& arm, const Task& task, const Pose& pose,
                           const Configuration& from, const Budget& budget);

}  // namespace beeline::internal
