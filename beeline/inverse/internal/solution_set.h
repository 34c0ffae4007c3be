#pragma once

#include <algorithm>

#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/numerical/posture_index.h>

namespace beeline::internal {

/// Returns the larger of the task's position and orientation error at q, by forward kinematics.
double error_at(const Request& request, const Configuration& q);

/// Returns the error up to which a solution of a closed form is not corrected. It is smaller than
/// the requested tolerance.
inline double needs_no_correction(double tolerance) { return std::max(1e-13, tolerance / 100); }

/// Adds the representative of the candidate q nearest to the seed to the solutions if it is within
/// limits, forward kinematics confirms it, and it is new. Levenberg-Marquardt steps correct its
/// last digits. `known`: an index of the solutions, for many calls; default: none.
void add_solution(const Request& request, const Configuration& q, InverseResult& result,
                  PostureIndex* known = nullptr);

/// Completes a result that has solutions: adds the representatives with other multiples of 2 pi if
/// they are requested, sorts, keeps the first unless all are requested, and fills in status and
/// residual.
void finish(const Request& request, InverseResult& result);

}  // namespace beeline::internal
