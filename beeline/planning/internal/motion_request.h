#pragma once

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/verify.h>
#include <beeline/planning/free_path.h>
#include <beeline/planning/move_along.h>
#include <beeline/timing/retime.h>

namespace beeline::internal {

/// A motion along a route, with the options of each of its stages. Each stage takes its own options
/// and a meter that replaces their budgets.
struct MotionRequest {
  const Arm& arm;
  std::optional<Configuration> start;  ///< default: the best configuration at the path's beginning
  const Route& route;
  BranchOptions branch;  ///< options and budget of the plan without times
  RetimeOptions timing;
  VerifyOptions proof;
  ClearanceOptions clearance = {};  ///< options of BlockedMotions::reason

  const Task& task() const { return branch.task; }

  /// A fraction of the tolerance of the proof.
  Deviation tolerance(double fraction = 1) const {
    return {fraction * proof.tolerance, fraction * proof.orientation_tolerance};
  }
};

/// Return the options of the stages of a motion. `tolerated` is the fraction of the tolerance that
/// a branch may use.
BranchOptions branch_options(const Arm& arm, const PathMotionOptions& options, double tolerated);
RetimeOptions timing_options(const PathMotionOptions& options);
FreeMotionOptions free_motion_options(const PathMotionOptions& options);
VerifyOptions proof_options(const PathMotionOptions& options);
ClearanceOptions clearance_options(const PathMotionOptions& options);

}  // namespace beeline::internal
