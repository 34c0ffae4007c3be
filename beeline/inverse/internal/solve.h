#pragma once

#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Whether a request without solutions is diagnosed, which takes longer than solving most requests.
enum class ReasonSearch { wanted, skipped };

/// Solves one pose: checks the request, runs the stages, then diagnoses a failure or resolves
/// redundancy and sorts the solutions. The status is that of the budget if it ended a step that
/// might have changed the solutions.
InverseResult solve(SolverState& state, const Pose& world_T_tool, const Configuration& seed,
                    ReasonSearch diagnosis, BudgetMeter& budget);

}  // namespace beeline::internal
