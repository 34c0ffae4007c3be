#pragma once

#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Whether a request without solutions is diagnosed: that takes longer than most solutions.
enum class Diagnosis { wanted, skipped };

/// Solves one pose: request, stages, diagnosis or redundancy, order of the solutions.
InverseResult solve(SolverState& state, const Pose& world_T_tool, const Configuration& seed,
                    Diagnosis diagnosis);

}  // namespace beeline::internal
