#pragma once

#include <optional>

#include <beeline/inverse/internal/infeasibility.h>
#include <beeline/inverse/internal/request.h>

namespace beeline::internal {

/// The stages' evidence about solutions when joint limits are ignored. diagnose() derives the
/// status of a request without solutions from it.
struct UnconstrainedResult {
  bool complete = false;           ///< whether all solutions that exist have been examined
  bool branches_complete = false;  ///< the same, or a solution of every branch of infinitely many
  bool doubtful = false;           ///< whether rounding may have hidden a solution
  bool continuum = false;          ///< whether some solutions represent infinitely many
  /// Every branch was followed over the range of the redundant joint and is outside the limits.
  bool range_examined = false;
  std::optional<Infeasibility> violation;  ///< a proof that there are no solutions
  /// The solution with the smallest excess() over the limits.
  std::optional<Configuration> least_outside;
  double excess = 0;  ///< excess of `least_outside`

  /// Replaces `least_outside` by q's representative nearest to the seed if its excess over the
  /// limits is less.
  void consider(const Request& request, const Configuration& q);
};

/// The solutions and evidence that the stages have found so far.
struct StageResult {
  InverseResult result;  ///< solutions within limits, their method, and the number of iterations
  UnconstrainedResult unconstrained;
};

}  // namespace beeline::internal
