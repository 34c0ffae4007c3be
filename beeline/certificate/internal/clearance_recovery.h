#pragma once

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/internal/motion_tubes.h>
#include <beeline/internal/budget_meter.h>

namespace beeline::internal {

/// Distance by which a pair may come closer in a recovery, and a start may be deeper, m.
constexpr double recovery_slack = 1e-9;

/// Whether a start that is closer than its clearance by `depth` may be led out of it with this
/// ClearanceOptions::recover_clearance.
constexpr bool may_recover_clearance(double depth, double recover_clearance) {
  return recover_clearance > 0 && depth <= recover_clearance + recovery_slack;
}

/// Throws Error unless `depth` is from 0 to max_recover_clearance.
void check_recover_clearance(double depth);

/// Proves that all pairs keep their clearance at all times, with the closest approach if the
/// options ask for it.
ClearanceProof prove_throughout(const CollisionModel& model, const MotionTubes& tubes,
                                const ClearanceOptions& options, BudgetMeter& budget);

/// Does the same for a motion that may start closer than the clearance by
/// options.recover_clearance, see ClearanceRecovery. A motion that starts deeper is examined as
/// without the option.
ClearanceProof prove_with_recovery(const CollisionModel& model, const MotionTubes& tubes,
                                   const ClearanceOptions& options, BudgetMeter& budget);

}  // namespace beeline::internal
