#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Returns when and how a recording first leaves the arm's position limits: at a sample, or between
/// two samples with velocities, by their cubic. Returns no reason if it does not. Throws Error when
/// the recording does not fit the arm.
Reason first_violation(const Arm& arm, const Trajectory& recording);

}  // namespace beeline::internal
