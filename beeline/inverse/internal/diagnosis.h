#pragma once

#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/internal/stage_result.h>

namespace beeline::internal {

/// Fills in status, residual, nearest miss and reason of a result without solutions, from the
/// evidence and from searches for the nearest pose; or, where one of these finds a solution, that.
/// Every status but `solved` is chosen here.
void diagnose(SolverState& state, const Request& request, const UnconstrainedResult& evidence,
              InverseResult& result);

}  // namespace beeline::internal
