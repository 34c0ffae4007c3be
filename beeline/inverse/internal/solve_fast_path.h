#pragma once

#include <optional>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Writes solutions into the columns by the fastest method, without the stages, if none of them
/// needs a correction. Returns their number, or nothing if solve() is needed. A solution of a
/// closed form is checked by closing the loop. Does not allocate in the ordinary case.
std::optional<int> solve_fast_path(SolverState& state, const Pose& goal,
                                   const ConfigurationRef& seed, BudgetMeter& budget,
                                   const Eigen::Ref<Eigen::MatrixXd>& solutions);

/// Returns one solution, checked by forward kinematics, as a result. Returns nothing if solve() is
/// needed.
std::optional<InverseResult> one_solution_fast(SolverState& state, const Pose& world_T_tool,
                                               const ConfigurationRef& seed, BudgetMeter& budget);

}  // namespace beeline::internal
