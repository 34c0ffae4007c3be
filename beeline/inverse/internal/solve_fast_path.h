#pragma once

#include <optional>

#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Writes solutions into the columns by the fastest method, without the stages, where none of them
/// needs a correction; returns how many, or nothing where solve() is needed. A closed form's
/// solution is checked by closing the loop. Does not allocate in the ordinary case.
std::optional<int> solve_fast_path(SolverState& state, const Pose& goal,
                                   const ConfigurationRef& seed,
                                   Eigen::Ref<Eigen::MatrixXd> solutions);

}  // namespace beeline::internal
