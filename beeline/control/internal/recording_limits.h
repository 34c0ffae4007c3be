#pragma once

#include <string>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Describes when and how a recording first leaves the arm's position limits: at a sample, or
/// between two samples with velocities, by their cubic. Empty when it does not. Throws Error when
/// the recording does not fit the arm.
std::string first_violation(const Arm& arm, const Trajectory& recording);

}  // namespace beeline::internal
