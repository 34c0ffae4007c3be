#pragma once

#include <beeline/inverse/internal/diagnosis.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Solves one pose: by run_quick_stages() if these suffice, else by solve_thoroughly(). Without
/// solutions, `detail` says what is found out about the request; the nearest miss takes longer than
/// solving most requests.
InverseResult solve(SolverState& state, const Pose& world_T_tool, const ConfigurationRef& seed,
                    FailureDetail detail, BudgetMeter& budget);

/// Solves one pose by all stages, then resolves redundancy. If the budget ended a step that might
/// have changed the solutions, the status is the ending of the budget.
InverseResult solve_thoroughly(SolverState& state, const Pose& world_T_tool,
                               const ConfigurationRef& seed, FailureDetail detail,
                               BudgetMeter& budget);

/// Writes the solutions nearest to the seed into the columns, as many as fit, and returns their
/// number. Does not allocate in the ordinary case.
int solve_into(SolverState& state, const Pose& world_T_tool, const ConfigurationRef& seed,
               BudgetMeter& budget, Eigen::Ref<Eigen::MatrixXd> solutions);

}  // namespace beeline::internal
