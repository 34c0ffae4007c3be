#pragma once

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Returns the tool's motion in the world: pose, velocity J dq and acceleration J ddq + J' dq, at
/// configuration q with its first and second derivative. Throws Error when q does not fit the arm;
/// dq and ddq must have its size.
PoseMotion tool_motion(const Arm& arm, const ConfigurationRef& q, const ConfigurationRef& dq,
                       const ConfigurationRef& ddq);

}  // namespace beeline::internal
