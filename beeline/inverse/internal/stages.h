#pragma once

#include <beeline/inverse/internal/solutions.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Sets state.family, or state.fallback, to the first family of closed forms that applies. Neither
/// is set for InverseMethod::numerical.
void select_family(SolverState& state);

/// Runs the stages of inverse kinematics: the seed, proofs that there is no solution, the closed
/// form, the search. Each adds solutions within limits, and evidence about solutions when limits
/// are ignored. If there are no solutions, diagnose() derives the status from the evidence.
void run_stages(SolverState& state, const Request& request, StageResult& found);

/// Runs the two stages that suffice for most requests, with request.quick: the closed form, and the
/// search if it may find a solution. Returns whether their solutions need nothing else: they are
/// all, or one if one is requested; or there is none, as every branch was followed or the pose is
/// out of reach.
bool run_quick_stages(SolverState& state, const Request& request, StageResult& found);

}  // namespace beeline::internal
