#pragma once

#include <span>

#include <beeline/collision/collision_model.h>
#include <beeline/reason.h>

namespace beeline::internal {

/// Returns the reason of a pair that is closer than its clearance, without a time: bodies_collide
/// with the depth if the bodies may touch, else bodies_too_close with the distance. `links` are the
/// ones of the model: the reason names the joint that is held and carries one of the bodies.
Reason too_close_reason(const BodyDistance& pair, std::span<const LinkShapes> links);

/// Returns the reason of a pair whose distance is not decided to be its clearance or more.
Reason not_decided_reason(const BodyDistance& pair);

}  // namespace beeline::internal
