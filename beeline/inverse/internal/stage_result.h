#pragma once

#include <optional>

#include <beeline/inverse/internal/infeasibility.h>
#include <beeline/inverse/internal/request.h>

namespace beeline::internal {

/// What the stages know of the solutions when joint limits are ignored: the evidence from which
/// diagnose() derives the status of a request without solutions.
struct UnconstrainedResult {
  bool complete = false;                   ///< all solutions that exist have been examined
  bool doubtful = false;                   ///< rounding may have hidden one
  bool continuum = false;                  ///< some of them stand for infinitely many
  std::optional<Infeasibility> violation;  ///< a proof that there are none
  std::optional<Configuration> least;      ///< the solution that is least outside the limits ...
  double excess = 0;                       ///< ... and by how much: see excess(Bounds)

  /// Takes q's representative nearest to the seed as `least` where it is less outside.
  void consider(const Request& request, const Configuration& q);
};

/// What the stages have found so far.
struct StageResult {
  InverseResult result;  ///< the solutions within limits, how they were found, what it took
  UnconstrainedResult unconstrained;
};

}  // namespace beeline::internal
