#pragma once

#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/internal/stage_result.h>

namespace beeline::internal {

/// Runs the stages of inverse kinematics in the order of their table in stages.cpp: each adds
/// solutions within limits, and evidence about those that exist when limits are ignored.
/// diagnose() turns the evidence into a status where there are no solutions.
StageResult run_stages(SolverState& state, const Request& request);

}  // namespace beeline::internal
