#pragma once

#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/solutions.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// Adds the solutions that multi_start() finds. If none is within limits, adds the evidence of a
/// search without limits. With request.quick there are few restarts. Those that find nothing are
/// followed by a few without limits, which often show that there is nothing to find.
void solve_numerical(SolverState& state, const Request& request, StageResult& found);

/// Writes the solution within limits to which a search from the seed converges into q, if the tool
/// is near the pose at the seed. Returns whether there is one.
bool search_from_seed(SolverState& state, const Request& request, Configuration& q);

/// Writes the solution within limits to which gauss_newton() converges from `start` or, with
/// `damped`, Levenberg-Marquardt, which takes longer, into q. Returns whether there is one.
/// Allocates in the thread's first call only.
bool solution_from(SolverState& state, const Request& request, const double* start, bool damped,
                   Configuration& q);

/// Moves the last solution of solution_from(), q, to a local minimum of the distance from the seed.
/// Returns whether q is a solution.
bool approach_seed(SolverState& state, const Request& request, Configuration& q);

/// Moves the solutions of a request with near_seed to local minima of the distance from the seed.
void approach_seed(SolverState& state, const Request& request, StageResult& found);

/// Runs Levenberg-Marquardt within limits from up to eight solutions outside them, and writes the
/// first that converges into q. Returns whether one converges. Allocates in the thread's first call
/// only.
bool solve_from_outside(SolverState& state, const Request& request, const LeastOutside& outside,
                        Configuration& q);

}  // namespace beeline::internal
