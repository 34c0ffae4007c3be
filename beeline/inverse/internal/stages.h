#pragma once

#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/internal/stage_result.h>

namespace beeline::internal {

/// Runs the stages of inverse kinematics in the order of their table in stages.cpp. Each adds
/// solutions within limits, and evidence about solutions when limits are ignored. If there are no
/// solutions, diagnose() derives the status from the evidence.
StageResult run_stages(SolverState& state, const Request& request);

}  // namespace beeline::internal
