#pragma once

#include <beeline/inverse/internal/request.h>

namespace beeline::internal {

/// Replaces the solutions by the one that optimises request.options.redundancy: the best of these,
/// of the one to which Levenberg-Marquardt converges from the seed, and of what optimised() makes
/// of each.
void optimise_redundancy(const Request& request, InverseResult& result);

/// Moves a solution q along the arm's self-motion to a local optimum of request.options.redundancy:
///   minimise |q - seed|^2, or maximise the least margin to the limits (joints without do not
///   count) subject to the task and the bounds.
/// Newton's method in the null space of the task's Jacobian, each step followed by
/// levenberg_marquardt() back to the pose. Returns a solution within bounds, no worse than q.
Configuration optimised(const Request& request, const Configuration& q);

}  // namespace beeline::internal
