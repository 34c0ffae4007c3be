#pragma once

#include <beeline/inverse/internal/stage_result.h>
#include <beeline/inverse/numerical/posture_index.h>

namespace beeline::internal {

/// Takes the candidate solutions of a closed form, limits ignored. Each is corrected and checked by
/// forward kinematics; it then counts as evidence and, within limits, as a solution.
class CandidateSolutions {
 public:
  CandidateSolutions(const Request& request, StageResult& found)
      : request_(request), found_(found) {}

  UnconstrainedResult& evidence() { return found_.unconstrained; }

  /// With `continuum`, q represents infinitely many solutions.
  void add(Configuration q, bool continuum);

 private:
  const Request& request_;
  StageResult& found_;
  PostureIndex known_;
};

}  // namespace beeline::internal
