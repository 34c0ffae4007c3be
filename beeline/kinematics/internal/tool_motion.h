#pragma once

#include <span>

#include <beeline/math/polynomial.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Returns the tool's motion in the world: pose, velocity J dq and acceleration J ddq + J' dq, at
/// configuration q with its first and second derivative. Throws Error when q does not fit the arm;
/// dq and ddq must have its size.
PoseMotion tool_motion(const Arm& arm, const ConfigurationRef& q, const ConfigurationRef& dq,
                       const ConfigurationRef& ddq);

/// The same where each coordinate is a polynomial of u, with derivatives with respect to u.
PoseMotion tool_motion(const Arm& arm, std::span<const Polynomial> coordinates, double u);

}  // namespace beeline::internal
