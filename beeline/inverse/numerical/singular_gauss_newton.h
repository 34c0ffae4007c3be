#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {

/// Solves for a configuration at the pose from a `start` near a singularity. levenberg_marquardt()
/// stagnates there, because its normal equations lose the singular values of the Jacobian below
/// about 1e-7. This solver keeps them to rounding. With J = sum sigma_i u_i v_i^T, each step
/// is
///   dq = sum over i of clamp(u_i . e / sigma_i, +-0.3 rad) v_i,
/// over the directions whose error u_i . e exceeds the tolerance, subject to the bounds. Steps are
/// taken whether or not they reduce |e|: at a solution where the Jacobian loses rank, Gauss-Newton
/// halves the distance, but not in every step. A step takes about ten times as long as one of
/// levenberg_marquardt(). Returns the configuration of least error that was met. Throws as it does.
NumericalResult singular_gauss_newton(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                      const Bounds& bounds, const Configuration& start,
                                      const NumericalOptions& options = {});

}  // namespace beeline::internal
