#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// Solves for a configuration at the pose from a `start` near a singularity, such as a pose at the
/// boundary of the workspace. levenberg_marquardt() stagnates there, because its normal equations
/// lose the singular values of the Jacobian below about 1e-7, and where the error is quadratic in
/// some directions, Gauss-Newton steps converge linearly or not at all. Runs Newton's method on the
/// singular configuration; if that fails, Gauss-Newton on the singular values from its result.
/// Returns the configuration of least error that the last of them met, within the bounds. Throws as
/// levenberg_marquardt() does.
NumericalResult singular_solution(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                  const Bounds& bounds, const Configuration& start,
                                  const NumericalOptions& options = {});

}  // namespace beeline::internal
