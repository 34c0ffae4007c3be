#pragma once

#include <beeline/inverse/internal/failure_status.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Solves one pose: checks the request, runs the stages, then resolves redundancy and sorts the
/// solutions. Without solutions, `detail` says what is found out about the request; the nearest
/// miss takes longer than solving most requests. If the budget ended a step that might have changed
/// the solutions, the status is the ending of the budget.
InverseResult solve(SolverState& state, const Pose& world_T_tool, const Configuration& seed,
                    FailureDetail detail, BudgetMeter& budget);

}  // namespace beeline::internal
