#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/internal/diagnosis.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Solves one pose by the fastest method. With options.blocked_by, moves the solutions that it has
/// a reason against to InverseResult::blocked; if this leaves none although one was requested,
/// computes all solutions and gives the first that has no reason, in the order of
/// options.redundancy. A status without the nearest miss leaves the request in
/// InverseResult::unexplained.
InverseResult solve_unblocked(SolverState& state, const Pose& world_T_tool,
                              const ConfigurationRef& seed, FailureDetail detail,
                              BudgetMeter& budget);

}  // namespace beeline::internal
