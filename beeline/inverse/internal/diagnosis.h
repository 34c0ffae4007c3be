#pragma once

#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/internal/stage_result.h>

namespace beeline::internal {

/// Sets the status unreachable, orientation_unreachable or outside_limits, with its reason. The
/// reason of the first two has values if result.nearest is known.
void set_no(const Request& request, const UnconstrainedResult& evidence, InverseStatus status,
            InverseResult& result);

/// Fills in status, residual, nearest miss and reason of a result without solutions, from the
/// evidence and from searches for the nearest pose. If a search finds a solution, the result is
/// that solution. This function chooses every status except `solved`.
void diagnose(SolverState& state, const Request& request, const UnconstrainedResult& evidence,
              InverseResult& result);

}  // namespace beeline::internal
