#pragma once

#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Max starts of a search for the nearest pose. Each converges to a local minimum of the error.
/// More starts find the global minimum more often, and take longer.
inline constexpr int max_starts = 64;

Deviation deviation_at(const Request& request, const Configuration& q);

/// Returns the task's rows for the position.
Task position_part(const Task& task);

/// Returns the configuration of least error in the rows of `task` among the ends of max_starts
/// searches, limits ignored. A reference into the state.
const Configuration& nearest_of_searches(const Request& request, const Task& task,
                                         SolverState& state, const ConfigurationRef& start);

/// The same; a local minimum is then located to rounding by Newton's method, up to max_refined
/// joints.
Configuration nearest_for(const Request& request, const Task& task, SolverState& state,
                          const ConfigurationRef& start);

/// Whether Newton's method converges from q to a local minimum of the error above `least`, units of
/// length and radians, limits ignored. It does not from next to a solution, singular or not.
bool is_minimum_above(const Request& request, Configuration q, double least);

/// Returns the configuration of least orientation error among many at the goal's position, or
/// `start` if it does not reach that position.
Configuration nearest_orientation_of_many(const Request& request, const Task& position,
                                          SolverState& state, const Configuration& start);

}  // namespace beeline::internal
