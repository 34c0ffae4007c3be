#pragma once

#include <functional>
#include <string>
#include <vector>

#include <beeline/inverse/inverse_kinematics.h>

#include "pose_argument.h"
#include "scene_argument.h"

namespace beeline::command {

/// InverseOptions::blocked_by for a scene, which must outlive the result.
std::function<Reason(const ConfigurationRef&)> blocked_in(const CheckedScene& scene);

/// A line for each of the first solutions that are blocked: joint values, the two bodies and their
/// distance. Empty without any.
std::string blocked_text(const Arm& arm, const std::vector<BlockedSolution>& blocked,
                         const UnitArgument& unit);
Json json_blocked(const Arm& arm, const std::vector<BlockedSolution>& blocked,
                  const UnitArgument& unit);

/// The pairs that count, the clearance, the bodies, exemptions and assumptions.
std::string scene_text(const CheckedScene& scene);
Json scene_document(const CheckedScene& scene);

}  // namespace beeline::command
