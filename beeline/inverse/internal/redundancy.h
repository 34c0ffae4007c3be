#pragma once

#include <beeline/inverse/internal/request.h>

namespace beeline::internal {

/// Puts the solution that request.options.redundancy wants in the place of those that were found:
/// the best of these, and of the one that a descent from the seed leads to, each of them settled().
void settle(const Request& request, InverseResult& result);

/// From a solution q along the arm's self-motion to the one that request.options.redundancy wants,
/// as far as steps downhill go: the nearest to the seed, or the farthest from the limits (joints
/// that have none do not count). Newton's method on the cost in the null space of the task's
/// Jacobian, each step followed by a descent back to the pose; joints that reach a bound stay on
/// it. Returns a solution within bounds that is no worse than q.
Configuration settled(const Request& request, const Configuration& q);

}  // namespace beeline::internal
