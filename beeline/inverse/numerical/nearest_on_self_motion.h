#pragma once

#include <beeline/inverse/numerical/gauss_newton.h>

namespace beeline::internal {

/// Moves near.q, a solution of gauss_newton(), along the self-motion to a local minimum of
/// sum weights_k (q_k - start_k)^2 within the bounds, by at most eight of Newton's steps with the
/// curvature of the secant. A start within some tenths of a radian needs one or two; the distance
/// is then the minimum's to about 1e-4. `start`, which may be outside the bounds, and `weights`:
/// radians and metres. Requires one redundant joint. Returns whether near.q is a solution still.
bool approach_start(const NumericalProblem& problem, const Pose& world_T_tool, const double* start,
                    const double* weights, const LaneOptions& options, GaussNewtonState& near);

}  // namespace beeline::internal
