#pragma once

#include <beeline/inverse/internal/solutions.h>

namespace beeline::internal {

/// Replaces the solutions by the one that optimises request.options.redundancy. The candidates are
/// these solutions, the one to which Levenberg-Marquardt converges from the seed, and the result of
/// optimised() for each.
void optimise_redundancy(const Request& request, StageResult& found);

/// Returns what request.options.redundancy minimises at a solution: for Redundancy::centred, minus
/// the least margin to the limits, else the distance from the seed.
double redundancy_objective(const Request& request, const Configuration& q);

/// Moves a solution q by self-motion to a local optimum of request.options.redundancy:
///   minimise |q - seed|^2, or maximise the least margin to the limits (joints without do not
///   count) subject to the task and the bounds.
/// Each step of Newton's method in the null space of the task's Jacobian is followed by
/// levenberg_marquardt() back to the pose. Returns a solution within bounds, no worse than q.
Configuration optimised(const Request& request, const Configuration& q);

}  // namespace beeline::internal
