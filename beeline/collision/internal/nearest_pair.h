#pragma once

#include <beeline/collision/collision_model.h>

namespace beeline::internal {

/// Where CollisionBodies::apart_pairs count: only at configurations outside the position limits, or
/// at all configurations.
enum class ApartPairs { outside_limits, count };

/// nearest_pair() with the choice of the pairs that count.
BodyDistance nearest_pair(const CollisionModel& model, const ConfigurationRef& q, ApartPairs apart);

/// Returns whether a pair counts at a configuration.
bool has_pairs(const CollisionModel& model, const ConfigurationRef& q);

}  // namespace beeline::internal
