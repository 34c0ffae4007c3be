#pragma once

#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Returns the arm with a joint appended for each component in which the tool may deviate from the
/// pose. The coordinate of such a joint is the deviation, so the last frame is at the pose if the
/// tool is within options.pose_tolerance of it. `limited`: whether the arm's own limits are kept.
Arm with_deviations(const Arm& arm, const Eigen::VectorXd& tolerance, bool limited);

/// Searches for a solution within options.pose_tolerance of the goal, reduces its deviation, and
/// returns the result.
std::optional<InverseResult> solve_within_tolerance(SolverState& state, const Request& request);

}  // namespace beeline::internal
