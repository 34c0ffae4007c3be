#pragma once

#include <beeline/certificate/clearance.h>
#include <beeline/certificate/internal/motion_tubes.h>
#include <beeline/internal/budget_meter.h>

namespace beeline::internal {

/// Completes the proof that a motion is clear, see ClearanceOptions::closest: finds the pair and
/// the time with the least distance beyond the clearance, and proves the motion for a clearance
/// that is raised to nearly that distance. A distance that was found only proposes the clearance to
/// be proved. If the budget ends the search, the proof has what was proved before.
void find_closest_approach(const CollisionModel& model, const MotionTubes& tubes,
                           const ClearanceOptions& options, BudgetMeter& budget,
                           ClearanceProof& proof);

}  // namespace beeline::internal
