#pragma once

#include <optional>

#include <beeline/inverse/internal/solutions.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

/// What is found out about a request without solutions.
enum class FailureDetail {
  none,     ///< nothing
  status,   ///< the status; and the nearest miss unless the status is known without it
  nearest,  ///< status and nearest miss
};

/// Returns the status of a request without solutions within limits, if it is known without the
/// nearest miss: from a proof, or because the closed form examined all solutions, or all searches
/// ended far from the pose. Otherwise returns nothing, and diagnose() chooses the status.
std::optional<InverseStatus> status_without_nearest(SolverState& state, const Request& request,
                                                    const UnconstrainedResult& evidence);

/// Sets this status and its reason, without a nearest miss. The residual is NaN unless a proof
/// gives it.
void set_unexplained(const Request& request, InverseStatus status, StageResult& found);

/// Fills in status, residual, nearest miss and reason of a result without solutions, from the
/// evidence and from searches for the nearest pose. If a search finds a solution, the result is
/// that solution. Other functions set `solved`, `blocked` and the endings of a budget only.
void diagnose(SolverState& state, const Request& request, StageResult& found);

}  // namespace beeline::internal
