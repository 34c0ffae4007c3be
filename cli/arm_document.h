#pragma once

#include <beeline/io/text/json.h>
#include <beeline/model/arm.h>

namespace beeline::command {

/// The document of `beeline show --json`: name, joints with their limits, dof, planar, reach.
/// Angles are in rad or in degrees.
Json arm_document(const Arm& arm, bool degrees);

}  // namespace beeline::command
