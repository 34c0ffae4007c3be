#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/motion_request.h>

namespace beeline::internal {

/// Returns the status of a motion or a configuration that the clearance refuses for this reason.
MotionStatus status_of_blocked(const Reason& reason);

/// Returns the reason against a motion, within the budget; none if it is not blocked.
Reason blocked_reason(const BlockedMotions& blocked_by, ClearanceOptions options,
                      BudgetMeter& budget, const Trajectory& motion);

/// Replaces a motion by its refusal, which keeps how far the path was followed.
void refuse(MotionStatus status, Reason reason, PathMotion& motion);

/// Returns `best`, the planned motion of the best branch, if it is not blocked. Otherwise plans a
/// motion of a redundant arm whose self-motion keeps clear and then, without a start, the other
/// branches, and returns the first that is not blocked. If every one is, returns the reason of the
/// best.
PathMotion unblocked_motion(const MotionRequest& request, const BlockedMotions& blocked_by,
                            PathMotion best, BudgetMeter& budget);

}  // namespace beeline::internal
