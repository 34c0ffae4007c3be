#pragma once

#include <optional>

#include <beeline/collision/collision_model.h>
#include <beeline/internal/budget_meter.h>

namespace beeline::internal {

/// Returns a configuration near `start` to which the straight joint motion is proved to lead out of
/// the clearance from a depth of at most `depth`, m; see ClearanceRecovery. Nothing if the start
/// keeps its clearance or is deeper, or if none is found. The configurations that are tried are
/// found by descent on the pairs that are too close (Gauss-Newton along the gradients of their
/// distances), with more and more distance to spare.
std::optional<Configuration> clearance_exit(const CollisionModel& model, const Configuration& start,
                                            double depth, BudgetMeter& budget);

}  // namespace beeline::internal
