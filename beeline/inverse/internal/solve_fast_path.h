#pragma once

#include <optional>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/internal/failure_status.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// The outcome of solve_fast_path().
struct FastSolutions {
  int count = 0;  ///< number of solutions written
  /// Without any, whether the range of the redundant joint was examined, and no branch outside the
  /// limits needs a correction.
  bool examined = false;
  bool outside = false;  ///< whether that examination found a solution outside the limits
};

/// Writes solutions into the columns by the fastest method, without the stages, if none of them
/// needs a correction. Returns nothing if solve() is needed. A solution of a
/// closed form is checked by closing the loop. Does not allocate in the ordinary case.
std::optional<FastSolutions> solve_fast_path(SolverState& state, const Pose& goal,
                                             const ConfigurationRef& seed, BudgetMeter& budget,
                                             const Eigen::Ref<Eigen::MatrixXd>& solutions);

/// Returns one solution, checked by forward kinematics, as a result; with FailureDetail::status
/// also a status without solutions that needs no nearest miss. Returns nothing if solve() is
/// needed.
std::optional<InverseResult> one_solution_fast(SolverState& state, const Pose& world_T_tool,
                                               const ConfigurationRef& seed, FailureDetail detail,
                                               BudgetMeter& budget);

}  // namespace beeline::internal
