#pragma once

#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/internal/stage_result.h>

namespace beeline::internal {

/// Whether a closed form or the general solver of six joints was prepared.
bool has_analytic_stage(const SolverState& state);

/// Adds the solutions of the closed form or of the general solver. Requires has_analytic_stage().
void solve_analytic(SolverState& state, const Request& request, StageResult& found);

/// Adds the solutions of six revolute joints of any geometry, and replaces the evidence.
void solve_raghavan_roth(const RaghavanRothSolver& general, const Request& request,
                         StageResult& found);

}  // namespace beeline::internal
