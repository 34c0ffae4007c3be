#pragma once

#include <beeline/model/arm.h>

#include "command/json.h"

/// The document of `beeline show --json`: name, joints with their limits, dof, planar, reach.
/// Angles are in rad or in degrees.
Json arm_document(const beeline::Arm& arm, bool degrees);
