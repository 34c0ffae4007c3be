#pragma once

#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/internal/stage_result.h>

namespace beeline::internal {

/// Adds the solutions that multi_start() finds; evidence from a search without limits where there
/// is none within them.
void solve_numerical(SolverState& state, const Request& request, StageResult& found);

/// multi_start() for one solution, from the seed into the first column. Returns whether there is
/// one. Allocates in the first call only.
bool search_fast_path(SolverState& state, const Pose& goal, const ConfigurationRef& seed,
                      Eigen::Ref<Eigen::MatrixXd> solutions);

/// Levenberg-Marquardt within limits from up to eight solutions outside them; the first that
/// converges goes into q. Returns whether one did. Allocates in the first call only.
bool solve_from_outside(SolverState& state, const Pose& goal, const LeastOutside& outside,
                        double tolerance, Eigen::Ref<Configuration> q);

}  // namespace beeline::internal
