#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/motion_request.h>

namespace beeline::internal {

/// PathMotionOptions::blocked_by.
using BlockedBy = std::function<Reason(const Trajectory&, const Budget&)>;

/// Returns the status of a motion or a configuration that the clearance refuses for this reason.
MotionStatus status_of_blocked(const Reason& reason);

/// Returns `best`, the planned motion of the best branch, if blocked_by has no reason against it.
/// Otherwise, without a start, plans the other branches and returns the best one without a reason.
/// If every one has a reason, returns the reason of the best.
PathMotion unblocked_motion(const MotionRequest& request, const BlockedBy& blocked_by,
                            PathMotion best, BudgetMeter& budget);

}  // namespace beeline::internal
