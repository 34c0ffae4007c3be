#pragma once

#include <beeline/inverse/internal/request.h>

namespace beeline::internal {

/// The larger of the task's position and orientation error at q, by forward kinematics.
double error_at(const Request& request, const Configuration& q);

/// Adds q's representative nearest to the seed to the solutions, if it is within limits, forward
/// kinematics confirms it, and it is not among them. `q` is a configuration that some method claims
/// to be a solution; Levenberg-Marquardt steps correct its last digits.
void add_solution(const Request& request, const Configuration& q, InverseResult& result);

/// Completes a result that has solutions: adds the representatives by other turns where they are
/// requested, sorts, keeps the first unless all are requested, and fills in status and residual.
void finish(const Request& request, InverseResult& result);

}  // namespace beeline::internal
