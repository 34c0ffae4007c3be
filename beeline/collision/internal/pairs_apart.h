#pragma once

#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/internal/budget_meter.h>

namespace beeline::internal {

/// Moves the pairs of `self_pairs` that are proved to keep their clearance at all configurations
/// within the position limits to `apart_pairs`, and sets the range of coordinates for which this
/// holds. A box of configurations for which the bounds of a joint tube do not suffice is halved
/// (branch and bound); a pair that is too close at the middle of a box is left. The pairs that the
/// budget leaves undecided are left, too. The pairs of `known`, the bodies of the same arm with
/// fewer links or none, are not searched again.
void find_pairs_apart(CollisionBodies& bodies, BudgetMeter& budget,
                      const CollisionBodies* known = nullptr);

}  // namespace beeline::internal
