#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// Solves for a configuration at a pose at the boundary of the workspace, or at another pose whose
/// Jacobian J = sum sigma_i u_i v_i^T loses rank. The error is then quadratic in some directions,
/// and Gauss-Newton steps converge linearly or not at all. Newton's method on
///   u_i . e = 0                   for the directions i in which the tool moves,
///   v_j . (u_i . J)^T = 0         for the others, over the v_j of those and of the null space,
/// converges quadratically to the singular configuration from a `start` near it, because the second
/// equations are linear in the distance. Directions count as lost where sigma_i is below 2 % of the
/// largest, or if that fails below 0.2 %. Returns the configuration of least error that was met,
/// clamped to the bounds. Throws as levenberg_marquardt() does.
NumericalResult singular_configuration(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                       const Bounds& bounds, const Configuration& start,
                                       const NumericalOptions& options = {});

}  // namespace beeline::internal
